// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "class_names.hpp"
#include "combination_arguments.hpp"
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "load_arguments.hpp"
#include "look_arguments.hpp"
#include "map_hints.hpp"
#include "mapping_text.hpp"
#include "mapping_times.hpp"
#include "network_arguments.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "outputs.hpp"
#include "placement_argument.hpp"
#include "places.hpp"
#include "progress.hpp"
#include "time_arguments.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

struct MapArguments {
  DatasetArguments dataset;
  NetworkArguments network;
  LookArguments looks;
  MappingJob job;
  DetectionFiles detections;
  std::vector<std::string> transient;
  std::vector<std::string> kept_classes;
  std::string preset = "default";
  std::optional<std::string> config;
  std::optional<std::string> mode;
  std::optional<std::string> resolution_m;
  std::optional<std::string> max_range_m;
  CombinationArguments combination;
  bool refine_poses = false;
  bool class_stack = false;
  MappingTimesArguments times;
  std::optional<std::string> transform;
  std::string places;
  ClassNames class_names;
  int num_threads = 0;
  LoadArguments load;
};

/// Preset, then the options file, then the command line.
Result<MappingJob> job_of(const MapArguments& arguments) {
  MappingJob job = arguments.job;
  job.input = arguments.dataset.input;
  job.limits = arguments.load.limits;
  job.looks = arguments.looks.options();
  HYPERMAP_ASSIGN_OR_RETURN(job.dataset, arguments.dataset.options());
  arguments.detections.put_into(job.dataset);
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, arguments.dataset.detector());
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, arguments.network.applied_to(job.detector));
  job.combiner = arguments.combination.combiner;
  MapOptions options;
  options.mapper.objects = preset(*preset_of(arguments.preset));
  if (arguments.config) {
    HYPERMAP_ASSIGN_OR_RETURN(options, read_options(*arguments.config, options));
  }
  const std::optional<std::string> refinement =
      arguments.refine_poses ? std::optional<std::string>("point_to_plane") : std::nullopt;
  const std::optional<std::string> class_stack =
      arguments.class_stack ? std::optional<std::string>("true") : std::nullopt;
  const std::optional<std::string> prior =
      arguments.places.empty() ? std::nullopt : std::optional<std::string>("places");
  const std::optional<std::string> weights = arguments.combination.weights_text();
  const std::optional<std::string> stacking = arguments.combination.rule_text();
  HYPERMAP_ASSIGN_OR_RETURN(options,
                            with_flags(std::move(options),
                                       {{"integration.mode", arguments.mode},
                                        {"stacking.rule", stacking},
                                        {"stacking.weights", weights},
                                        {"octree.resolution_m", arguments.resolution_m},
                                        {"integration.max_range_m", arguments.max_range_m},
                                        {"refinement.rule", refinement},
                                        {"prior.source", prior},
                                        {"projection.class_stack", class_stack}}));
  job.mapper = std::move(options.mapper);
  job.layers = options.layers;
  if (job.mapper.prior.source == ClassPriorKind::kPlaces) {
    HYPERMAP_ASSIGN_OR_RETURN(job.place_rules, read_place_rules(places_file(arguments.places)));
  }
  auto& transient = job.mapper.objects.transient_class_names;
  transient.insert(transient.end(), arguments.transient.begin(), arguments.transient.end());
  auto& wanted = job.mapper.wanted_class_names;
  wanted.insert(wanted.end(), arguments.kept_classes.begin(), arguments.kept_classes.end());
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, arguments.class_names.given());
  HYPERMAP_ASSIGN_OR_RETURN(job.placement, placement_of(arguments.transform));
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  job.mapper.num_threads = arguments.num_threads > 0 ? arguments.num_threads : std::max(cores, 1);
  HYPERMAP_TRY(validate(job.mapper));
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
  if (arguments.job.strict && worst == ExitCode::kFindings) worst = ExitCode::kRefused;
  print_mapping_report(*mapped, *job);
  print_hints_after(*mapped, *job);
  const auto written = arguments.times.write(*mapped, arguments.dataset.input);
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
  arguments.dataset.add_to(command);
  command.add_option("--output", arguments.job.output, "archive to write")->required();
  arguments.detections.add_to(command);
  auto* model = command.add_option(
      "--model", arguments.job.model, "network (ONNX) to run on each image, a detector");
  arguments.network.add_to(command, *model);
  arguments.looks.add_to(command, *model);
  command
      .add_option("--preset",
                  arguments.preset,
                  "where options start from; hypermap takes a tenth of a second or more a frame")
      ->transform(one_of(preset_names()))
      ->capture_default_str();
  command.add_option("--config", arguments.config, "YAML file of options, see `hypermap config`");
  command
      .add_option(
          "--mode", arguments.mode, "what frees space: every ray, one per voxel, or projection")
      ->transform(choice_of_option("integration.mode"))
      ->default_str(default_of_option("integration.mode"));
  command.add_option("--resolution", arguments.resolution_m, "edge of a voxel")
      ->check(value_of_option("octree.resolution_m"))
      ->default_str(default_of_option("octree.resolution_m"));
  command
      .add_option(
          "--max-range", arguments.max_range_m, "farther depth only frees, and shows no object")
      ->check(value_of_option("integration.max_range_m"))
      ->default_str(default_of_option("integration.max_range_m"));
  arguments.combination.add_to(command);
  command
      .add_option("--up", arguments.job.up_axis, "axis of the dataset's world, or floor to find it")
      ->transform(one_of({"x", "-x", "y", "-y", "z", "-z", "floor"}));
  command
      .add_option("--transient",
                  arguments.transient,
                  "transient classes, separated by commas: they update neither objects nor voxels")
      ->delimiter(',');
  add_keep_classes(command, arguments.kept_classes);
  auto* append =
      command.add_flag("--append", arguments.job.append, "go on from the archive at --output");
  add_append_options(command, *append, arguments);
  command
      .add_option("--poses",
                  arguments.job.poses,
                  "corrected trajectory (TUM's form, or .log by frame) instead of the dataset's")
      ->excludes(append);
  command.add_flag("--refine-poses",
                   arguments.refine_poses,
                   "mend given poses that are a little wrong by the surfaces that earlier frames "
                   "showed (refinement.rule)");
  command.add_option(
      "--places",
      arguments.places,
      "YAML file with what belongs where, as data/places.yaml: what stands around an "
      "object then counts for its class (prior.source places)");
  arguments.class_names.add_to(command, "which the map keeps");
  command
      .add_option("--session",
                  arguments.job.session,
                  "name of this run in the map, by which query --session asks for what it saw")
      ->check(name_of_session());
  command.add_flag("--views",
                   arguments.job.keep_views,
                   "keep the best colour view of each object, a small image");
  command.add_flag("--stack",
                   arguments.class_stack,
                   "keep a layer `stack` too: log-odds for each class, which stack and cells take "
                   "(projection.class_stack)");
  command
      .add_option("--checkpoint-every",
                  arguments.job.checkpoint_every,
                  "save OUTPUT.checkpoint after every N frames, until the map is saved")
      ->check(CLI::Range(1, 1000000000).description("1 .. 1000000000"));
  command.add_flag("--resume",
                   arguments.job.resume,
                   "go on from OUTPUT.checkpoint, which the same command left when it was "
                   "interrupted");
  command.add_option("--max-skipped", arguments.job.max_skipped_share, "share of frames to lose")
      ->check(number_in(0.0, 1.0))
      ->capture_default_str();
  command.add_flag("--strict",
                   arguments.job.strict,
                   "a finding before the first frame ends the run; any finding ends with 2");
  command.add_option("--threads", arguments.num_threads, "mapping, saving; 0: one for each core")
      ->check(CLI::Range(0, 256).description("0 .. 256"))
      ->capture_default_str();
  arguments.times.add_to(command);
  arguments.load.add_to(command);
}

void keep_outputs_apart(const MapArguments& arguments) {
  const DatasetArguments& dataset = arguments.dataset;
  std::vector<std::filesystem::path> read{dataset.description.value_or(""),
                                          dataset.classes.value_or(""),
                                          arguments.config.value_or(""),
                                          arguments.class_names.file,
                                          arguments.places,
                                          arguments.job.model.value_or(""),
                                          arguments.combination.combiner.value_or(""),
                                          arguments.job.poses.value_or("")};
  const auto& detections = arguments.detections.files;
  read.insert(read.end(), detections.begin(), detections.end());
  const std::filesystem::path checkpoint =
      arguments.job.checkpoint_every > 0 || arguments.job.resume
          ? checkpoint_path(arguments.job.output)
          : "";
  arguments.times.keep_outputs_apart(read, {arguments.job.output, checkpoint});
  keep_apart("--checkpoint-every", checkpoint, read);
  read.emplace_back(dataset.input);
  keep_apart("--output", arguments.job.output, read);
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
    if (arguments->dataset.classes && !arguments->job.model &&
        arguments->detections.files.empty()) {
      throw CLI::ValidationError("--classes", "names the outputs of --model or --detections");
    }
    arguments->looks.keep_to_rule();
    arguments->detections.keep_to_files();
    keep_outputs_apart(*arguments);
    action = [arguments, &common] { return run(*arguments, common.progress); };
  });
}

}  // namespace hypermap::app
