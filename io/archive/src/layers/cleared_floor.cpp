// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/cleared_floor.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/grids/obstacle_rims.hpp"
#include "hypermap/projection/grids/rooms.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

Result<OccupancyLayer> without_objects(const MapArchive& archive,
                                       const Layer& occupancy,
                                       ObjectRims rims) {
  OccupancyLayer cleared = *occupancy.content.as<OccupancyLayer>();
  const Layer* semantic = archive.hypermap.find(kSemanticLayer);
  const auto* shapes = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  if (shapes == nullptr) return cleared;
  if (semantic->info.frame_id != occupancy.info.frame_id) {
    return fail(ErrorCode::kUnsupported,
                "must be in the frame of the occupancy grid, " +
                    printable(occupancy.info.frame_id) + ", is in " +
                    printable(semantic->info.frame_id),
                std::string(kSemanticLayer));
  }
  std::vector<Polygon> furniture;
  for (const SemanticObject& object : shapes->objects()) {
    furniture.insert(furniture.end(), object.parts.begin(), object.parts.end());
  }
  cleared.grid = without_obstacles(std::move(cleared.grid), furniture);
  if (rims == ObjectRims::kGo) cleared.grid = without_rims(std::move(cleared.grid), furniture);
  return cleared;
}

}  // namespace hypermap
