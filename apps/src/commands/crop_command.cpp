// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "edited_map.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/cropped_map.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"
#include "part_text.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace hypermap::app {
namespace {

struct CropArguments {
  std::string file;
  std::string area;
  std::optional<double> min_z_m;
  std::optional<double> max_z_m;
  std::string output;
  LoadArguments load;
};

/// Errors: kInvalidArgument naming the option.
Result<CropRegion> region_of(const CropArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(auto ring, parse_points(arguments.area, "--area"));
  auto area = make_polygon(std::move(ring));
  if (!area) return fail(area.error().code, area.error().what, "--area");
  CropRegion region{.area = std::move(*area)};
  if (arguments.min_z_m) region.min_z_m = *arguments.min_z_m;
  if (arguments.max_z_m) region.max_z_m = *arguments.max_z_m;
  if (!(region.min_z_m < region.max_z_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be above --min-z (" + number_text(region.min_z_m) + "), is " +
                    number_text(region.max_z_m),
                "--max-z");
  }
  return region;
}

/// Whether a voxel, an object, a shape, a known cell, a vertex or a true object is there.
bool has_content(const MapArchive& part) {
  if (num_voxels(part) > 0 || !part.objects.empty() || !part.class_grids.empty()) return true;
  if (part.topological_map && !part.topological_map->vertices().empty()) return true;
  if (part.true_surfaces && !part.true_surfaces->objects.empty()) return true;
  return std::ranges::any_of(part.hypermap.layers(), [](const Layer& layer) {
    if (const auto* shapes = layer.content.as<SemanticLayer>()) return !shapes->objects().empty();
    const auto* occupancy = layer.content.as<OccupancyLayer>();
    return occupancy != nullptr &&
           occupancy->grid.counts().unknown < occupancy->grid.cells().size();
  });
}

/// Says on stderr what could not be divided, and when the part has nothing.
ExitCode remark(const CroppedMap& part, const std::string& file) {
  const ExitCode left_out = warn_of_left_out("crop", part.left_out);
  if (has_content(part.map)) return left_out;
  return report(Finding{.error = {.code = ErrorCode::kNotFound,
                                  .what = "nothing of the map lies in it",
                                  .file = file,
                                  .field = "--area"}});
}

ExitCode run_crop(const CropArguments& arguments, const CropRegion& region) {
  const auto crop = [&](const MapArchive& whole) -> Result<EditedMap> {
    HYPERMAP_ASSIGN_OR_RETURN(auto part, cropped(whole, region));
    std::string text = std::to_string(num_voxels(part.map)) + " of " +
                       count_text(num_voxels(whole), "voxel") + ", " +
                       std::to_string(part.map.objects.size()) + " of " +
                       count_text(whole.objects.size(), "object") + "\n" + arguments.output + "\n";
    const ExitCode findings = remark(part, arguments.file);
    return EditedMap{.map = std::move(part.map), .text = std::move(text), .findings = findings};
  };
  return run_edit(arguments.file, arguments.output, arguments.load, crop);
}

}  // namespace

void add_crop_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<CropArguments>();
  CLI::App& command = *program.add_subcommand("crop", "Part of a map: what lies in an area");
  command.add_option("map", arguments->file, "archive")->required();
  command
      .add_option("--area",
                  arguments->area,
                  "polygon \"x y,x y,x y,...\" in frame map, metres: voxels, cells, objects and "
                  "places whose middle lies in it stay")
      ->required();
  command.add_option("--min-z", arguments->min_z_m, "m; voxels, objects and places from here on");
  command.add_option("--max-z", arguments->max_z_m, "m; those below");
  command.add_option("--output", arguments->output, "archive to write")->required();
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap crop lab.hmap --area \"0 0,4 0,4 3,0 3\" --output corner.hmap",
                 "hypermap crop lab.hmap --area \"0 0,4 0,4 3\" --max-z 1.2 --output low.hmap"});
  command.callback([arguments, &action] {
    keep_suffix("--output", arguments->output, ".hmap");
    keep_apart("--output", arguments->output, {arguments->file});
    auto region = region_of(*arguments);
    if (!region) throw CLI::ValidationError(region.error().field, region.error().what);
    action = [arguments, region = *region] { return run_crop(*arguments, region); };
  });
}

}  // namespace hypermap::app
