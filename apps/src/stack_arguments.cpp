// SPDX-License-Identifier: BSD-3-Clause
#include "stack_arguments.hpp"

#include "choices.hpp"
#include "command.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_table.hpp"
#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/tiles/tile_map.hpp"
#include "hypermap/projection/grids/layer_options.hpp"
#include "hypermap/projection/stack/asked_layers.hpp"
#include "hypermap/projection/stack/stack_services.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "stack_area.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hypermap::app {
namespace {

/// In the order of the enumerators.
std::vector<std::string> rule_names() {
  const auto& rows = option_table(ResamplingOptions{}).rows;
  const auto row = std::ranges::find(rows, "rule", &OptionRow::name);
  return {row->choices.begin(), row->choices.end()};
}

FusedLayer parse_fused(const std::string& text) {
  const auto parsed = parse_weighted(text, "--fuse");
  if (!parsed) throw CLI::ValidationError("--fuse", parsed.error().what);
  return {.name = parsed->name, .weight = parsed->weight};
}

/// A layer of the map that is a stack.
Result<GridStack> stored_stack(const MapArchive& map, const std::string& name) {
  const auto layer = map.hypermap.at(name);
  if (!layer) return Unexpected(of_option(layer.error(), "--from"));
  const auto* stack = (*layer)->content.as<GridStackLayer>();
  if (stack != nullptr && stack->stack()) return *stack->stack();
  return fail(ErrorCode::kUnsupported, "layer " + printable(name) + " is no stack", "--from");
}

/// What is taken of a map's voxels and layers.
std::vector<CLI::Option*> add_voxel_options(CLI::App& command, StackArguments& arguments) {
  const OptionTable& heights = option_table(LayerOptions{});
  ClassStackRequest& request = arguments.request.of_classes;
  CLI::Option* min_height =
      command
          .add_option("--min-height", request.band.min_m, "of voxels that count, over the floor")
          ->check(value_of_field(heights, "min_height_m"))
          ->capture_default_str();
  CLI::Option* max_height =
      command
          .add_option("--max-height", request.band.max_m, "of voxels that count, over the floor")
          ->check(value_of_field(heights, "max_height_m"))
          ->capture_default_str();
  CLI::Option* classes =
      command
          .add_option(
              "--class",
              request.classes,
              "only these, as query --string takes them, separated by commas; may be repeated")
          ->delimiter(',');
  CLI::Option* fused =
      command
          .add_option("--fuse",
                      arguments.fused,
                      "NAME or NAME=WEIGHT: an occupancy layer of the map, as one more layer; "
                      "without one what is "
                      "occupied but has no class, as walls, counts as free; may be repeated")
          ->delimiter(',');
  CLI::Option* keep_share =
      command.add_option("--keep-share", request.options.keep_share, "of evidence when new comes")
          ->check(value_of_field(option_table(GridStackOptions{}), "keep_share"))
          ->capture_default_str();
  return {min_height, max_height, classes, fused, keep_share};
}

/// Full names of what `--layer` asks for. Errors: those of asked_layers.
Result<std::vector<std::string>> layers_asked_for(const std::vector<std::string>& texts,
                                                  const GridStack& stack,
                                                  const ClassVocabulary& vocabulary) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    auto asked = asked_layers(text, stack, vocabulary);
    if (!asked) return Unexpected(of_option(asked.error(), "--layer"));
    names.insert(names.end(), asked->begin(), asked->end());
  }
  return names;
}

/// Which layers are cut out, and where.
void add_cut_options(CLI::App& command, StackArguments& arguments) {
  command
      .add_option(
          "--layer",
          arguments.layers,
          "only these layers, with or without /ism/, separated by commas; one stands also for "
          "layers whose names go on after it and a slash (detections: detections/chair); else a "
          "class "
          "as query --string takes it; may be repeated")
      ->delimiter(',');
  CLI::Option* area_option =
      command.add_option("--area", arguments.area, "X0,Y0,X1,Y1 in the map's frame (default: all)");
  command
      .add_option("--yaw",
                  arguments.yaw_deg,
                  "degrees by which the area is turned about X0,Y0; maps that are "
                  "written to a folder are turned back and padded")
      ->check(number_in(-360.0, 360.0))
      ->needs(area_option);
  command
      .add_option("--resolution",
                  arguments.resolution_m,
                  "edge of a cell (default: that of voxels or tiles)")
      ->check(number_in(0.001, 10.0));
  command.add_option("--rule", arguments.rule, "how values between cells are had")
      ->transform(one_of(rule_names()))
      ->capture_default_str();
  command
      .add_option_function<double>(
          "--epsilon",
          [&request = arguments.request](double p) { request.resampling.epsilon = Probability(p); },
          "no cell counts as surer than this (default: 1e-06)")
      ->check(value_of_field(option_table(ResamplingOptions{}), "epsilon"));
}

}  // namespace

std::string full_layer_name(const GridStackOptions& options, const std::string& name) {
  return name.starts_with('/') ? name : options.parent + "/" + name;
}

void tell_cells_without_class(const char* command, std::optional<std::size_t> num_cells) {
  if (!num_cells || *num_cells == 0) return;
  std::fprintf(
      stderr,
      "%s: what is occupied in %s of the map has no class (walls, say): every class counts "
      "that as free; --fuse occupancy adds it as a layer\n",
      command,
      count_text(*num_cells, "cell").c_str());
}

void StackArguments::add_to(CLI::App& command) {
  command.add_option("file", file, "archive or configuration");
  CLI::Option* tiles_option = command.add_option(
      "--tiles", tiles, "folder of tiles to take instead of a file, ours or [sogm]'s");
  CLI::Option* from_option =
      command.add_option("--from", from, "take this layer of the map, a stack, not its voxels")
          ->excludes(tiles_option);
  command
      .add_option("--archive", archive, "the map with what is made here as layers, as an archive")
      ->type_name("FILE");
  for (CLI::Option* of_voxels : add_voxel_options(command, *this)) {
    of_voxels->excludes(tiles_option)->excludes(from_option);
  }
  add_cut_options(command, *this);
  sensed.add_to(command);
  class_names.add_to(command);
  load.add_to(command);
}

void StackArguments::keep_to_one_source() const {
  if (file.empty() && tiles.empty()) {
    throw CLI::ValidationError("FILE", "a map, or --tiles FOLDER, must be named");
  }
  std::error_code failed;
  if (!file.empty() && std::filesystem::is_directory(file, failed)) {
    throw CLI::ValidationError(
        "FILE", "is a folder, not a map: --tiles takes one of tiles, --input frames beside a map");
  }
  if (file.empty() || tiles.empty()) return;
  throw CLI::ValidationError("--tiles",
                             "the stack is made of the file '" + printable(file) +
                                 "' or of tiles, not of both: one of them must go");
}

void StackArguments::keep_heights_in_order() const {
  const HeightBand& band = request.of_classes.band;
  if (const auto checked = check_above("--min-height", band.min_m, "--max-height", band.max_m);
      !checked) {
    throw CLI::ValidationError("--max-height", checked.error().what);
  }
}

void StackArguments::finish() {
  keep_to_one_source();
  keep_heights_in_order();
  const auto names = rule_names();
  request.resampling.rule =
      static_cast<ResamplingRule>(std::ranges::find(names, rule) - names.begin());
  request.fused.clear();
  for (const std::string& text : fused) request.fused.push_back(parse_fused(text));
  sensed.job.classes = request.of_classes.classes;
  sensed.job.heights.max_obstacle_m = request.of_classes.band.max_m;
  sensed.finish();
  if (archive) {
    keep_apart("--archive", *archive, {file});
    keep_suffix("--archive", *archive, ".hmap");
  }
  if (const auto parsed = parse_area(area); !parsed) {
    throw CLI::ValidationError("--area", parsed.error().what);
  }
}

Result<MapArchive> StackArguments::map() const {
  if (!tiles.empty()) return MapArchive{};
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded, load_archive(file, load.limits, archive_layer_types(), stop_when_interrupted()));
  return std::move(loaded.value);
}

Result<GridStack> StackArguments::uncut_stack(const MapArchive& map) const {
  if (from) return stored_stack(map, *from);
  if (tiles.empty()) return stack_of_map(map, request);
  HYPERMAP_ASSIGN_OR_RETURN(const auto around, rect_around_area(*this));
  auto stack = read_tile_map(tiles, around, request.of_classes.options);
  const bool is_of_one_tile = !stack && !stack.error().file.empty() && stack.error().file != tiles;
  if (!stack && stack.error().code == ErrorCode::kLimit && !is_of_one_tile) {
    stack.error().what += area ? "; a smaller --area takes less" : "; --area takes a part of it";
  }
  return stack;
}

Result<std::optional<std::size_t>> StackArguments::cells_without_class(
    const MapArchive& map) const {
  const bool is_of_voxels = !from && tiles.empty();
  if (!is_of_voxels || !request.fused.empty()) return std::optional<std::size_t>();
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t count,
                            num_cells_without_class(map, request.of_classes.band));
  return std::optional(count);
}

Result<StackOfFile> StackArguments::make(const CommonOptions& common) const {
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive whole_map, map());
  ClassVocabulary own_vocabulary = whole_map.vocabulary;
  HYPERMAP_TRY(class_names.replace(whole_map.vocabulary));
  std::optional<SensedStackReport> report;
  auto cut = [&]() -> Result<GridStack> {
    HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, uncut_stack(whole_map));
    HYPERMAP_ASSIGN_OR_RETURN(report, sensed.fuse_into(stack, whole_map));
    StackRequest asked{.geometry = {}, .layers = {}, .resampling = request.resampling};
    HYPERMAP_ASSIGN_OR_RETURN(asked.geometry, geometry_asked_for(*this, stack.geometry()));
    HYPERMAP_TRY(check_overlap(asked.geometry, stack.geometry()));
    HYPERMAP_ASSIGN_OR_RETURN(asked.layers, layers_asked_for(layers, stack, whole_map.vocabulary));
    Progress progress("cutting out layers", common.progress);
    auto part = cut_out(stack, asked, [&progress](std::size_t done, std::size_t total) {
      return progress.update(done, total);
    });
    if (part) return part;
    if (part.error().code != ErrorCode::kLimit) return part;
    return Unexpected(of_option(part.error(), "--area, --resolution"));
  }();
  if (!cut) return Unexpected(with_source(cut.error(), {tiles.empty() ? file : tiles}));
  HYPERMAP_ASSIGN_OR_RETURN(const auto without_class, cells_without_class(whole_map));
  whole_map.vocabulary = std::move(own_vocabulary);  // the call's is not saved
  return StackOfFile{.map = std::move(whole_map),
                     .stack = std::move(*cut),
                     .sensed = std::move(report),
                     .cells_without_class = without_class};
}

Result<std::vector<std::filesystem::path>> StackArguments::save(StackOfFile made,
                                                                std::vector<Layer> further) const {
  if (!archive) return std::vector<std::filesystem::path>{};
  further.push_back(
      {LayerInfo{.name = std::string(kStackLayer), .frame_id = made.stack.options().frame_id},
       GridStackLayer(std::move(made.stack))});
  for (Layer& layer : further) HYPERMAP_TRY(made.map.hypermap.put_layer(std::move(layer)));
  HYPERMAP_TRY(save_archive(made.map, *archive, {.limits = load.limits}));
  return std::vector<std::filesystem::path>{*archive};
}

}  // namespace hypermap::app
