// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "map_hints.hpp"
#include "mapping_arguments.hpp"
#include "mapping_text.hpp"
#include "mapping_times.hpp"
#include "outputs.hpp"
#include "placement_argument.hpp"
#include "progress.hpp"
#include "time_arguments.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

struct MapArguments {
  MappingArguments mapping;
  MappingJob job;  ///< What is of this command alone.
  DetectionFiles detections;
  MappingTimesArguments times;
  std::optional<std::string> transform;
};

Result<MappingJob> job_of(const MapArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(MappingJob job, arguments.mapping.job());
  const MappingJob& own = arguments.job;
  job.input = arguments.mapping.dataset.input;
  job.output = own.output;
  arguments.detections.put_into(job.dataset);
  job.poses = own.poses;
  job.append = own.append;
  job.same_world = own.same_world;
  job.force = own.force;
  job.session = own.session;
  job.checkpoint_every = own.checkpoint_every;
  job.resume = own.resume;
  HYPERMAP_ASSIGN_OR_RETURN(job.placement, placement_of(arguments.transform));
  return job;
}

ExitCode run(const MapArguments& arguments, const std::string& progress_when) {
  const auto job = job_of(arguments);
  if (!job) return report(job.error());
  print_hints_before(*job);
  if (const auto targets = arguments.times.check_targets(); !targets)
    return report(targets.error());
  Result<MappingReport> mapped;
  {
    Progress progress("mapping", progress_when);
    mapped = run_mapping(
        *job, [&](std::size_t done, std::size_t total) { return progress.update(done, total); });
  }
  if (!mapped) {
    const ExitCode refused = report(mapped.error());
    print_hint_at_resuming(mapped.error(), *job);
    return refused;
  }
  ExitCode worst = ExitCode::kDone;
  for (const Error& skipped : mapped->skipped) {
    worst = std::max(worst, report(Finding{Severity::kWarning, skipped}));
  }
  for (const Finding& finding : mapped->findings) worst = std::max(worst, report(finding));
  if (arguments.mapping.strict && worst == ExitCode::kFindings) worst = ExitCode::kRefused;
  print_mapping_report(*mapped, *job);
  print_hints_after(*mapped, *job);
  const auto written = arguments.times.write(*mapped, arguments.mapping.dataset.input);
  return written ? worst : report(written.error());
}

void add_append_options(CLI::App& command, CLI::Option& append, MapArguments& arguments) {
  auto* same_world =
      command
          .add_flag("--same-world",
                    arguments.job.same_world,
                    "with --append: the poses are in the world of what the map holds "
                    "(known without it when both descriptions name a `world`)")
          ->needs(&append)
          ->excludes(command.get_option("--up"));
  command
      .add_option("--transform",
                  arguments.transform,
                  "with --append: X,Y,Z,YAW in metres and degrees, where the input's world lies in "
                  "the map once +z is up in it")
      ->check(placement_text())
      ->needs(&append)
      ->excludes(same_world);
  command
      .add_flag(
          "--force", arguments.job.force, "with --append: map frames that are in the map already")
      ->needs(&append);
}

void add_options(CLI::App& command, MapArguments& arguments) {
  arguments.mapping.dataset.add_to(command);
  command.add_option("--output", arguments.job.output, "archive to write, .hmap")->required();
  arguments.detections.add_to(command);
  arguments.mapping.add_to(command);
  auto* append =
      command.add_flag("--append", arguments.job.append, "go on from the archive at --output");
  add_append_options(command, *append, arguments);
  command
      .add_option("--poses",
                  arguments.job.poses,
                  "corrected trajectory (TUM's form, or .log by frame) instead of the dataset's")
      ->excludes(append);
  command
      .add_option("--session",
                  arguments.job.session,
                  "name of this run in the map, by which query --session asks for what it saw")
      ->check(name_of_session());
  command
      .add_option("--checkpoint-every",
                  arguments.job.checkpoint_every,
                  "save OUTPUT.checkpoint after every N frames, until the map is saved")
      ->check(CLI::Range(1, 1000000000).description("1 .. 1000000000"));
  command.add_flag("--resume",
                   arguments.job.resume,
                   "go on from OUTPUT.checkpoint, which the same command left when it was "
                   "interrupted");
  arguments.times.add_to(command);
  arguments.mapping.load.add_to(command);
}

void keep_outputs_apart(const MapArguments& arguments) {
  std::vector<std::filesystem::path> read = arguments.mapping.files_read();
  read.push_back(arguments.job.poses.value_or(""));
  const auto& detections = arguments.detections.files;
  read.insert(read.end(), detections.begin(), detections.end());
  const std::filesystem::path checkpoint =
      arguments.job.checkpoint_every > 0 || arguments.job.resume
          ? checkpoint_path(arguments.job.output)
          : "";
  keep_apart("--checkpoint-every", checkpoint, read);
  read.emplace_back(arguments.mapping.dataset.input);
  arguments.times.keep_outputs_apart(read, {arguments.job.output, checkpoint});
  keep_apart("--output", arguments.job.output, read);
  if (!arguments.job.append) keep_suffix("--output", arguments.job.output, ".hmap");
}

}  // namespace

void add_map_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<MapArguments>();
  CLI::App& command = *program.add_subcommand("map", "The main job: a dataset becomes an archive");
  add_options(command, *arguments);
  show_examples(command,
                {"hypermap map --input lab --output lab.hmap --stats stats.json",
                 "hypermap map --input lab --detections detections.jsonl --resolution 0.03 "
                 "--output lab.hmap"});
  command.callback([arguments, &common, &action] {
    if (arguments->mapping.dataset.classes && !arguments->mapping.model &&
        arguments->detections.files.empty()) {
      throw CLI::ValidationError("--classes", "names the outputs of --model or --detections");
    }
    arguments->mapping.keep_to_rules();
    arguments->detections.keep_to_files();
    keep_outputs_apart(*arguments);
    action = [arguments, &common] { return run(*arguments, common.progress); };
  });
}

}  // namespace hypermap::app
