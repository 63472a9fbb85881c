// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "hypermap/core/base/preset_name.hpp"
#include "hypermap/io/jobs/merge_job.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "load_arguments.hpp"
#include "merge_text.hpp"
#include "outputs.hpp"
#include "placement_argument.hpp"
#include "progress.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

struct MergeArguments {
  std::vector<std::string> files;
  std::vector<std::string> transforms;
  bool registers = false;
  bool in_order = false;
  std::string preset = "default";
  std::optional<std::string> config;
  std::string output;
  bool json = false;
  LoadArguments load;
};

/// "FILE=X,Y,Z,YAW": of the map that is called so, with or without its folder and suffix.
Result<void> place_file(std::vector<MergedFile>& files, const std::string& text) {
  const auto equals = text.rfind('=');
  const std::string name = text.substr(0, equals);
  const auto file = std::ranges::find_if(files, [&](const MergedFile& one) {
    return one.path == name || one.path.filename() == name || one.path.stem() == name;
  });
  if (equals == std::string::npos || file == files.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be FILE=X,Y,Z,YAW with one of the maps, is '" + printable(text) + "'",
                "--transform");
  }
  if (file == files.begin()) {
    return fail(ErrorCode::kInvalidArgument,
                "is of the first map, in whose frame the others are placed",
                "--transform");
  }
  if (file->placement) {
    return fail(ErrorCode::kInvalidArgument,
                "must place each map once, places '" + printable(name) + "' twice",
                "--transform");
  }
  HYPERMAP_ASSIGN_OR_RETURN(file->placement, placement_of(text.substr(equals + 1)));
  return {};
}

/// Errors: kInvalidArgument naming the option.
Result<std::vector<MergedFile>> files_of(const MergeArguments& arguments) {
  std::vector<MergedFile> files;
  files.reserve(arguments.files.size());
  for (const std::string& file : arguments.files) files.push_back({.path = file});
  if (files.size() < 2) {
    return fail(ErrorCode::kInvalidArgument, "must be two or more, is one", "files");
  }
  for (const std::string& text : arguments.transforms) HYPERMAP_TRY(place_file(files, text));
  return files;
}

Result<MergeJob> job_of(const MergeArguments& arguments, const std::vector<MergedFile>& files) {
  MergeJob job{.files = files,
               .registers = arguments.registers,
               .in_order = arguments.in_order,
               .limits = arguments.load.limits,
               .stop = stop_when_interrupted()};
  job.options.mapper.objects = preset(*preset_of(arguments.preset));
  if (arguments.config) {
    HYPERMAP_ASSIGN_OR_RETURN(job.options, read_options(*arguments.config, job.options));
  }
  return job;
}

ExitCode run_merge_command(const MergeArguments& arguments,
                           const MergeJob& job,
                           const CommonOptions& common) {
  Progress progress("merging", common.progress);
  const auto merged = run_merge(
      job, [&](std::size_t done, std::size_t total) { return progress.update(done, total); });
  if (!merged) return report(of_motion(merged.error(), "--transform"));
  if (const auto saved =
          save_archive(merged->map, arguments.output, {.limits = arguments.load.limits});
      !saved) {
    return report(saved.error());
  }
  arguments.json ? print_merge_json(merged->report, arguments.output)
                 : print_merge(merged->report, arguments.output);
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : merged->report.findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_merge_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App& command =
      *program.add_subcommand("merge", "Maps of one place, by several sessions or robots, as one");
  command
      .add_option("files",
                  arguments->files,
                  "archives, two or more; the result lies in the frame of the first")
      ->required();
  command.add_option("--output", arguments->output, "archive to write; may be one of the maps")
      ->required();
  command.add_option("--transform",
                     arguments->transforms,
                     "FILE=X,Y,Z,YAW: where that map's origin lies in the first one, metres and "
                     "degrees (default: both have one origin); may be repeated");
  command.add_flag("--register",
                   arguments->registers,
                   "finds where maps without --transform lie in the first one, by what both show");
  command.add_flag("--in-order",
                   arguments->in_order,
                   "the maps were made one after the other as they are given, whatever their "
                   "stamps say: what a later one saw empty is gone");
  command
      .add_option(
          "--preset", arguments->preset, "where options start from, as when the maps were made")
      ->transform(one_of(preset_names()))
      ->capture_default_str();
  command.add_option("--config", arguments->config, "YAML file of options, see `hypermap config`");
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap merge monday.hmap tuesday.hmap --output both.hmap",
                 "hypermap merge robot_a.hmap robot_b.hmap --register --output both.hmap",
                 "hypermap merge a.hmap b.hmap --transform b=4.2,0,0,90 --output both.hmap"});
  command.callback([arguments, &common, &action] {
    keep_apart("--output", arguments->output, {});
    keep_suffix("--output", arguments->output, ".hmap");
    auto files = files_of(*arguments);
    if (!files) throw CLI::ValidationError(files.error().field, files.error().what);
    action = [arguments, files = *files, &common] {
      const auto job = job_of(*arguments, files);
      return job ? run_merge_command(*arguments, *job, common) : report(job.error());
    };
  });
}

}  // namespace hypermap::app
