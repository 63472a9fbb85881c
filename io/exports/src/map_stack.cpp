// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_stack.hpp"

#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "map_file_pair.hpp"

#include <algorithm>
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

Result<void> fuse_layer(GridStack& stack,
                        const MapArchive& archive,
                        const FusedLayer& fused,
                        const ResamplingOptions& resampling) {
  const ExportRequest named{.output = {}, .layer = fused.name, .classes = {}};
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, wanted_layer<OccupancyLayer>(archive, named));
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

Result<WrittenFiles> write_stack_maps(const GridStack& stack,
                                      const LogOddsGrid& combined,
                                      const std::filesystem::path& folder) {
  HYPERMAP_TRY(make_export_folder(folder));
  FileNames names;
  WrittenFiles written;
  const auto write = [&](const std::string& name, const LogOddsGrid& grid) -> Result<void> {
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid cells, trinary(grid));
    HYPERMAP_ASSIGN_OR_RETURN(
        const WrittenFiles pair,
        write_map_pair(OccupancyLayer(std::move(cells)), folder / name, false));
    written.insert(written.end(), pair.begin(), pair.end());
    return {};
  };
  HYPERMAP_TRY(write(names.add("combined"), combined));
  const std::size_t parent_bytes = stack.options().parent.size() + 1;
  for (const auto& [name, grid] : stack.layers()) {
    HYPERMAP_TRY(write(names.add(name.substr(parent_bytes)), grid));
  }
  return written;
}

}  // namespace hypermap
