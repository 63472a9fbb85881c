// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/occupancy_layer.hpp"

#include "hypermap/projection/layers/asked_cells.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <string>

namespace hypermap {
namespace {

LayerAnswer answer_of(const OccupancyGrid& grid, Cell cell) {
  const std::int8_t occupancy = grid.at(cell);
  return {.id = grid.geometry().index(cell),
          .name = std::string(occupancy_string(occupancy)),
          .value = occupancy,
          .position = centre(grid.geometry(), cell)};
}

bool is_asked_for(std::int8_t occupancy, const LayerQuery& query) {
  return (!query.value || *query.value == occupancy) &&
         (!query.text || query.text->contains(occupancy_string(occupancy)));
}

}  // namespace

LayerStatistics OccupancyLayer::statistics() const {
  LayerStatistics statistics{.cells = grid.counts(), .grid = grid.geometry()};
  if (grid.geometry().num_cells() == 0) return statistics;
  const Rect rect = hypermap::bounds(grid.geometry());
  statistics.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0),
                                          Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0));
  return statistics;
}

Result<std::vector<LayerAnswer>> OccupancyLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  for_each_asked_cell(grid.geometry(), query, [&](Cell cell) {
    if (is_asked_for(grid.at(cell), query)) answers.push_back(answer_of(grid, cell));
  });
  return answers;
}

std::vector<LayerPrimitive> OccupancyLayer::draw() const {
  return {DrawnOccupancy{grid}};
}

Result<void> OccupancyLayer::save(LayerWriter& writer) const {
  return writer.grid("", *this);
}

bool OccupancyLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap
