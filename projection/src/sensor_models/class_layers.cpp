// SPDX-License-Identifier: BSD-3-Clause
#include "class_layers.hpp"

#include "cell_lattice.hpp"

namespace hypermap {

Result<void> check_has_classes(const ClassRegistry& classes) {
  if (classes.size() > 0) return {};
  return fail(ErrorCode::kInvalidArgument, "there must be a class to speak of", "classes");
}

Result<ClassLayers> ClassLayers::create(const ClassRegistry& classes,
                                        const LayerPlace& place,
                                        const GridGeometry& geometry) {
  constexpr std::size_t kMaxCellsOfLayers = std::size_t{1} << 30U;
  if (classes.size() * geometry.num_cells() > kMaxCellsOfLayers) {
    return fail(ErrorCode::kLimit,
                std::to_string(classes.size()) + " grids together have more than 2^30 cells",
                "resolution_m");
  }
  ClassLayers layers;
  layers.grids_.reserve(classes.size());
  for (const std::string& name : classes.names()) {
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, LogOddsGrid::create(geometry));
    layers.grids_.push_back({.layer = stack_layer_name(place.parent, name),
                             .frame_id = place.frame_id,
                             .grid = std::move(grid)});
  }
  return layers;
}

Result<std::vector<SensorGrid>> ClassLayers::cropped() && {
  for (SensorGrid& sensor : grids_) {
    HYPERMAP_ASSIGN_OR_RETURN(sensor.grid, cropped_to_known(sensor.grid));
  }
  return std::move(grids_);
}

}  // namespace hypermap
