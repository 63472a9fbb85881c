// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_arguments.hpp"

#include "choices.hpp"
#include "commands/places.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

namespace hypermap::app {

void MappingArguments::add_model_to(CLI::App& command) {
  auto* option =
      command.add_option("--model", model, "network (ONNX) to run on each image, a detector");
  network.add_to(command, *option);
  looks.add_to(command, *option);
}

void MappingArguments::add_map_options_to(CLI::App& command) {
  command
      .add_option("--preset",
                  preset,
                  "where options start from; hypermap takes a tenth of a second or more a frame")
      ->transform(one_of(preset_names()))
      ->capture_default_str();
  command.add_option("--config", config, "YAML file of options, see `hypermap config`");
  command.add_option("--mode", mode, "what frees space: every ray, one per voxel, or projection")
      ->transform(choice_of_option("integration.mode"))
      ->default_str(default_of_option("integration.mode"));
  command.add_option("--resolution", resolution_m, "edge of a voxel")
      ->check(value_of_option("octree.resolution_m"))
      ->default_str(default_of_option("octree.resolution_m"));
  command.add_option("--max-range", max_range_m, "farther depth only frees, and shows no object")
      ->check(value_of_option("integration.max_range_m"))
      ->default_str(default_of_option("integration.max_range_m"));
  combination.add_to(command);
  command.add_option("--up", up_axis, "axis of the dataset's world, or floor to find it")
      ->transform(one_of({"x", "-x", "y", "-y", "z", "-z", "floor"}));
}

void MappingArguments::add_class_options_to(CLI::App& command) {
  command
      .add_option(
          "--transient",
          transient,
          "further transient classes, separated by commas: like people, they update neither "
          "objects nor voxels")
      ->delimiter(',');
  add_keep_classes(command, kept_classes);
  command.add_option(
      "--places",
      places,
      "YAML file with what belongs where and how large it is, as data/places.yaml: what stands "
      "around an object and its size then count for its class (prior.source places)");
  class_names.add_to(command, "which the map keeps");
}

void MappingArguments::add_run_options_to(CLI::App& command) {
  command.add_flag("--refine-poses",
                   refine_poses,
                   "mend given poses that are a little wrong by the surfaces that earlier frames "
                   "showed (refinement.rule)");
  command.add_flag(
      "--views", keeps_views, "keep the best colour view of each object, a small image");
  command.add_flag("--stack",
                   class_stack,
                   "keep a layer `stack` too: log-odds for each class, which stack and cells take "
                   "(projection.class_stack)");
  command.add_option("--max-skipped", max_skipped_share, "share of frames to lose")
      ->check(number_in(0.0, 1.0))
      ->capture_default_str();
  command.add_flag(
      "--strict", strict, "a finding before the first frame ends the run; any finding ends with 2");
  command.add_option("--threads", num_threads, "mapping, saving; 0: one for each core")
      ->check(CLI::Range(0, 256).description("0 .. 256"))
      ->capture_default_str();
}

void MappingArguments::add_to(CLI::App& command) {
  add_model_to(command);
  add_map_options_to(command);
  add_class_options_to(command);
  add_run_options_to(command);
}

void MappingArguments::keep_to_rules() const {
  looks.keep_to_rule();
}

std::vector<std::filesystem::path> MappingArguments::files_read() const {
  return {dataset.description.value_or(""),
          dataset.classes.value_or(""),
          config.value_or(""),
          class_names.file,
          places,
          model.value_or(""),
          combination.combiner.value_or("")};
}

int MappingArguments::threads() const {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  return num_threads > 0 ? num_threads : std::max(cores, 1);
}

Result<MapOptions> MappingArguments::map_options() const {
  MapOptions options;
  options.mapper.objects = hypermap::preset(*preset_of(preset));
  if (config) {
    HYPERMAP_ASSIGN_OR_RETURN(options, read_options(*config, options));
  }
  const auto said = [](bool is_said, const char* text) {
    return is_said ? std::optional<std::string>(text) : std::nullopt;
  };
  const std::optional<std::string> refinement = said(refine_poses, "point_to_plane");
  const std::optional<std::string> stack = said(class_stack, "true");
  const std::optional<std::string> prior = said(!places.empty(), "places");
  const std::optional<std::string> weights = combination.weights_text();
  const std::optional<std::string> stacking = combination.rule_text();
  return with_flags(std::move(options),
                    {{"integration.mode", mode},
                     {"stacking.rule", stacking},
                     {"stacking.weights", weights},
                     {"octree.resolution_m", resolution_m},
                     {"integration.max_range_m", max_range_m},
                     {"refinement.rule", refinement},
                     {"prior.source", prior},
                     {"projection.class_stack", stack}});
}

Result<MappingJob> MappingArguments::job() const {
  MappingJob job;
  job.limits = load.limits;
  job.model = model;
  job.looks = looks.options();
  job.up_axis = up_axis;
  job.keep_views = keeps_views;
  job.max_skipped_share = max_skipped_share;
  job.strict = strict;
  HYPERMAP_ASSIGN_OR_RETURN(job.dataset, dataset.options());
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, dataset.detector());
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, network.applied_to(job.detector));
  job.combiner = combination.combiner;
  HYPERMAP_ASSIGN_OR_RETURN(MapOptions options, map_options());
  job.mapper = std::move(options.mapper);
  job.layers = options.layers;
  if (job.mapper.prior.source == ClassPriorKind::kPlaces) {
    const std::filesystem::path file = places_file(places);
    HYPERMAP_ASSIGN_OR_RETURN(job.place_rules, read_place_rules(file));
    job.place_rules_name = file.filename().string();
  }
  auto& transient_names = job.mapper.objects.transient_class_names;
  std::ranges::copy_if(
      transient, std::back_inserter(transient_names), [&](const std::string& name) {
        return std::ranges::none_of(
            transient_names, [&](const std::string& known) { return is_spelling_of(name, known); });
      });
  auto& wanted = job.mapper.wanted_class_names;
  wanted.insert(wanted.end(), kept_classes.begin(), kept_classes.end());
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, class_names.given());
  job.mapper.num_threads = threads();
  HYPERMAP_TRY(validate(job.mapper));
  return job;
}

}  // namespace hypermap::app
