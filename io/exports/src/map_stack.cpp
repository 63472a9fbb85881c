// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_stack.hpp"

#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/staged_folder.hpp"
#include "map_file_pair.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

/// The shown voxels of the largest region. Errors: kNotFound when there are none.
Result<LeafSource> voxels_of(const MapArchive& archive) {
  const LeafSource leaves = shown_leaves(archive);
  if (!leaves) return fail(ErrorCode::kNotFound, "the map has no octree");
  return leaves_of_largest(leaves, MapRegions::find(leaves));
}

/// Errors: kNotFound, kUnsupported, of the flag that names it.
Result<const Layer*> occupancy_layer(const MapArchive& archive, const std::string& name) {
  auto layer = named_layer(archive, {.output = {}, .layer = name, .classes = {}});
  if (!layer) {
    layer.error().field = "--fuse";
    return layer;
  }
  if ((*layer)->content.as<OccupancyLayer>() != nullptr) return layer;
  return fail(ErrorCode::kUnsupported,
              "layer " + printable(name) + " is a " + printable((*layer)->content->class_name()) +
                  ", no occupancy grid",
              "--fuse");
}

Result<void> fuse_layer(GridStack& stack,
                        const MapArchive& archive,
                        const FusedLayer& fused,
                        const ResamplingOptions& resampling) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, occupancy_layer(archive, fused.name));
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid,
                            LogOddsGrid::of_occupancy(layer->content.as<OccupancyLayer>()->grid));
  HYPERMAP_TRY(stack.fuse({.layer = stack_layer_name(stack.options().parent, layer->info.name),
                           .frame_id = layer->info.frame_id,
                           .grid = std::move(grid),
                           .weight = fused.weight},
                          archive.hypermap.frames(),
                          resampling));
  return {};
}

constexpr std::string_view kCombinedName = "combined";

/// The files of a folder that are maps of map_server as they are written here; none of a folder
/// that is not there. Errors: kIo.
Result<std::set<std::string>> files_of_maps(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(folder, failed);
  if (std::filesystem::status_known(status) && !std::filesystem::is_directory(status)) return names;
  std::filesystem::directory_iterator entry;
  if (!failed) entry = std::filesystem::directory_iterator(folder, failed);
  for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
    if (entry->path().extension() != ".yaml") continue;
    const auto named = image_of_pair(entry->path());
    if (!named && named.error().code == ErrorCode::kIo) return Unexpected(named.error());
    if (!named || named->empty()) continue;
    names.insert(entry->path().filename().string());
    names.insert(*named);
    names.insert(std::filesystem::path(*named).replace_extension(".pgw").string());
  }
  if (!failed) return names;
  return Unexpected(
      Error{ErrorCode::kIo, "cannot be looked at: " + failed.message(), folder.string()});
}

/// Whether files of maps, as files_of_maps gives them, are those of a stack.
bool is_stack(const std::set<std::string>& maps) {
  return maps.contains(std::string(kCombinedName) + ".yaml");
}

std::string comma_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text;
}

bool bears_class(const LeafSample& leaf) {
  return leaf.occupied && leaf.best_class.has_value();
}

/// The error of class_stack: what is not found is of the flag of classes, or of those of heights.
Error of_flags(Error error) {
  if (error.code == ErrorCode::kNotFound && error.field.empty()) {
    error.field = "--min-height, --max-height";
  }
  return error;
}

/// Why a stack has no layer.
Error without_layers(const LeafSource& leaves, const ClassStackRequest& asked) {
  const std::string in_band = "between heights of " + number_text(asked.band.min_m) + " and " +
                              number_text(asked.band.max_m) + " m";
  if (!asked.classes.empty()) {
    return {ErrorCode::kNotFound,
            "no voxel of " + comma_list(asked.classes) + " lies " + in_band,
            "--class"};
  }
  bool has_class = false;
  leaves([&has_class](const LeafSample& leaf) { has_class = has_class || bears_class(leaf); });
  if (has_class) {
    return {ErrorCode::kNotFound,
            "no voxel that has a class lies " + in_band,
            "--min-height, --max-height"};
  }
  return {
      ErrorCode::kNotFound,
      "the map's voxels have no class, so that there is no layer; --fuse occupancy makes one of "
      "what is occupied"};
}

}  // namespace

Result<OccupancyGrid> trinary_cells(const LogOddsGrid& grid) {
  return guarded(ErrorCode::kInvalidArgument, "the map", [&]() -> Result<OccupancyGrid> {
    const MapMetadata usual;
    std::vector<std::int8_t> cells;
    cells.reserve(grid.cells().size());
    for (const LogOddsSteps steps : grid.cells()) {
      const double p = from_steps(steps).probability().value();
      const std::int8_t known = p < usual.free_thresh ? kFreeCell : kUnknownCell;
      cells.push_back(p > usual.occupied_thresh ? kOccupiedCell : known);
    }
    return OccupancyGrid::create(grid.geometry(), std::move(cells));
  });
}

Result<std::size_t> num_cells_without_class(const MapArchive& archive,
                                            const HeightBand& band_over_floor) {
  const HeightBand band = over(archive.floor, band_over_floor);
  HYPERMAP_ASSIGN_OR_RETURN(const LeafSource leaves, voxels_of(archive));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, projection_geometry(leaves, band));
  return guarded(ErrorCode::kInvalidArgument, "the cells", [&]() -> Result<std::size_t> {
    std::vector<bool> is_occupied(geometry.num_cells(), false);
    std::vector<bool> has_class(geometry.num_cells(), false);
    leaves([&](const LeafSample& leaf) {
      if (!leaf.occupied) return;
      for_each_column(geometry, band, leaf, [&](Cell cell, double /*covered*/, double /*height*/) {
        is_occupied[geometry.index(cell)] = true;
        if (bears_class(leaf)) has_class[geometry.index(cell)] = true;
      });
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < is_occupied.size(); ++i) {
      if (is_occupied[i] && !has_class[i]) ++count;
    }
    return count;
  });
}

Result<GridStack> stack_of_map(const MapArchive& archive, const MapStackRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const LeafSource leaves, voxels_of(archive));
  ClassStackRequest of_classes = request.of_classes;
  of_classes.band = over(archive.floor, of_classes.band);
  of_classes.options.frame_id = shown_frame_id(archive);
  of_classes.vocabulary = archive.vocabulary;
  auto of_voxels = class_stack(leaves, archive.classes, of_classes);
  if (!of_voxels) return Unexpected(of_flags(of_voxels.error()));
  GridStack stack = std::move(*of_voxels);
  for (const FusedLayer& fused : request.fused) {
    HYPERMAP_TRY(fuse_layer(stack, archive, fused, request.resampling));
  }
  if (!stack.layers().empty()) return stack;
  return Unexpected(without_layers(leaves, of_classes));
}

Result<bool> holds_stack_maps(const std::filesystem::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::set<std::string> maps, files_of_maps(folder));
  return is_stack(maps);
}

Result<void> check_stack_folder(const std::filesystem::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::set<std::string> maps, files_of_maps(folder));
  const bool may_replace = is_stack(maps);
  return require_replaceable(folder, "part of a stack's maps", [&](const std::string& name) {
    return may_replace && maps.contains(name);
  });
}

Result<WrittenFiles> write_stack_maps(const GridStack& stack,
                                      const LogOddsGrid& combined,
                                      const std::filesystem::path& folder) {
  HYPERMAP_TRY(check_stack_folder(folder));
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder));
  FileNames names;
  WrittenFiles written;
  const auto write = [&](const std::string& name, const LogOddsGrid& grid) -> Result<void> {
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid cells, trinary_cells(grid));
    HYPERMAP_ASSIGN_OR_RETURN(const MapFileSet files,
                              map_files(OccupancyLayer(std::move(cells)), name, false));
    for (const NamedBytes& file : {files.yaml, files.image, files.world}) {
      HYPERMAP_TRY(staged.write(file.name, file.bytes));
      written.push_back(folder / file.name);
    }
    return {};
  };
  HYPERMAP_TRY(write(names.add(kCombinedName), combined));
  const std::size_t parent_bytes = stack.options().parent.size() + 1;
  for (const auto& [name, grid] : stack.layers()) {
    HYPERMAP_TRY(write(names.add(name.substr(parent_bytes)), grid));
  }
  HYPERMAP_TRY(check_stack_folder(folder));  // the writing took a while
  HYPERMAP_TRY(staged.commit());
  return written;
}

}  // namespace hypermap
