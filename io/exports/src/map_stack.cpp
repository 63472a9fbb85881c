// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_stack.hpp"

#include "export_folder.hpp"
#include "export_parts.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/projection/stack/leaf_evidence.hpp"
#include "map_file_pair.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <set>
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

Result<std::set<ClassId>> classes_asked_for(const MapArchive& archive,
                                            const std::vector<std::string>& names) {
  const auto ids = archive.classes.find_all(names);
  if (!ids) return fail(ids.error().code, ids.error().what, "--class");
  return std::set<ClassId>(ids->begin(), ids->end());
}

Result<void> fuse_classes(GridStack& stack,
                          const MapArchive& archive,
                          const LeafSource& leaves,
                          const MapStackRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, classes_asked_for(archive, request.classes));
  HYPERMAP_ASSIGN_OR_RETURN(auto grids, project_class_evidence(leaves, request.band));
  for (ClassEvidenceGrid& evidence : grids) {
    const bool is_wanted = request.classes.empty() || wanted.contains(evidence.id);
    if (!is_wanted || !archive.classes.contains(evidence.id)) continue;
    std::string layer = stack_layer_name(stack.options().parent, archive.classes.name(evidence.id));
    if (stack.layers().contains(layer)) layer += "-" + std::to_string(evidence.id.value);
    HYPERMAP_TRY(stack.fuse({.layer = std::move(layer), .grid = std::move(evidence.grid)},
                            Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                            {.rule = ResamplingRule::kNearest}));
  }
  return {};
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
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, projection_geometry(leaves, request.band));
  if (geometry.num_cells() == 0) {
    return fail(ErrorCode::kNotFound,
                "no voxel lies between heights of " + number_text(request.band.min_m) + " and " +
                    number_text(request.band.max_m) + " m");
  }
  GridStackOptions options = request.options;
  options.frame_id = shown_frame_id(archive);
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, GridStack::create(geometry, std::move(options)));
  HYPERMAP_TRY(fuse_classes(stack, archive, leaves, request));
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
