// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_stack.hpp"

#include "export_folder.hpp"
#include "export_parts.hpp"
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
  if (!std::filesystem::is_directory(folder, failed)) return names;
  std::filesystem::directory_iterator entry(folder, failed);
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

/// As map_server tells cells apart.
Result<OccupancyGrid> trinary(const LogOddsGrid& grid) {
  const MapMetadata usual;
  std::vector<std::int8_t> cells;
  cells.reserve(grid.cells().size());
  for (const LogOddsSteps steps : grid.cells()) {
    const double p = from_steps(steps).probability().value();
    const std::int8_t known = p < usual.free_thresh ? kFreeCell : kUnknownCell;
    cells.push_back(p > usual.occupied_thresh ? kOccupiedCell : known);
  }
  return OccupancyGrid::create(grid.geometry(), std::move(cells));
}

}  // namespace

Result<GridStack> stack_of_map(const MapArchive& archive, const MapStackRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const LeafSource leaves, voxels_of(archive));
  ClassStackRequest of_classes = request.of_classes;
  of_classes.options.frame_id = shown_frame_id(archive);
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, class_stack(leaves, archive.classes, of_classes));
  for (const FusedLayer& fused : request.fused) {
    HYPERMAP_TRY(fuse_layer(stack, archive, fused, request.resampling));
  }
  if (!stack.layers().empty()) return stack;
  return fail(ErrorCode::kNotFound, "no class that was asked for stands between these heights");
}

Result<void> check_stack_folder(const std::filesystem::path& folder) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::set<std::string> maps, files_of_maps(folder));
  const bool is_stack = maps.contains(std::string(kCombinedName) + ".yaml");
  return require_replaceable(folder, "part of a stack's maps", [&](const std::string& name) {
    return is_stack && maps.contains(name);
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
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid cells, trinary(grid));
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
