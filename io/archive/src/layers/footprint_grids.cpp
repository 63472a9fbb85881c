// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/footprint_grids.hpp"

#include "hypermap/projection/grids/class_grids.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hypermap {
namespace {

constexpr double kPlainEdgeM = 0.05;
constexpr std::size_t kMaxFootprintCells = std::size_t{1} << 30U;
constexpr double kMaxSideCells = 65'535.0;

using ShapesByName = std::map<std::string, std::vector<Polygon>>;

const Layer* first_semantic_layer(const MapArchive& archive) {
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.content.as<SemanticLayer>() != nullptr) return &layer;
  }
  return nullptr;
}

/// None without cells.
const OccupancyGrid* occupancy_in(const MapArchive& archive, const std::string& frame_id) {
  for (const Layer& layer : archive.hypermap.layers()) {
    const auto* occupancy = layer.content.as<OccupancyLayer>();
    if (occupancy == nullptr || layer.info.frame_id != frame_id) continue;
    if (occupancy->grid.geometry().num_cells() > 0) return &occupancy->grid;
  }
  return nullptr;
}

ShapesByName shapes_by_name(const SemanticLayer& layer) {
  ShapesByName shapes;
  for (const SemanticObject& object : layer.objects()) {
    auto& of_name = shapes[object.name];
    of_name.insert(of_name.end(), object.parts.begin(), object.parts.end());
  }
  return shapes;
}

/// The cells of `geometry` and as many more, on its lattice, as hold all shapes.
Result<GridGeometry> continued_around(const GridGeometry& geometry, const ShapesByName& shapes) {
  Eigen::AlignedBox2d box;
  if (geometry.num_cells() > 0) {
    box.extend(Eigen::Vector2d::Zero());
    box.extend(Eigen::Vector2d(geometry.cols, geometry.rows));
  }
  for (const auto& [name, polygons] : shapes) {
    for (const Polygon& polygon : polygons) {
      for (const Eigen::Vector2d& point : polygon.outer) box.extend(to_cells(geometry, point));
    }
  }
  const Eigen::Vector2d low = box.min().array().floor();
  const Eigen::Vector2d size = box.max().array().ceil().matrix() - low;
  if (size.maxCoeff() > kMaxSideCells) {
    return fail(ErrorCode::kLimit,
                "the shapes lie over more than 65,535 cells of " +
                    std::to_string(geometry.resolution_m) + " m in a row");
  }
  GridGeometry continued = geometry;
  continued.origin = from_cells(geometry, low);
  continued.cols = static_cast<int>(size.x());
  continued.rows = static_cast<int>(size.y());
  HYPERMAP_TRY(validate(continued));
  return continued;
}

/// Unknown where `occupancy` knows nothing, elsewhere free. Row and column 0 of `occupancy` lie at
/// a cell's corner of `geometry`.
Result<OccupancyGrid> seen_floor(const GridGeometry& geometry, const OccupancyGrid* occupancy) {
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid floor, OccupancyGrid::create(geometry, kUnknownCell));
  if (occupancy == nullptr) return floor;
  const GridGeometry& seen = occupancy->geometry();
  const Eigen::Vector2d offset = to_cells(geometry, seen.origin).array().round();
  for (int row = 0; row < seen.rows; ++row) {
    for (int col = 0; col < seen.cols; ++col) {
      if (occupancy->at({col, row}) == kUnknownCell) continue;
      floor.set({col + static_cast<int>(offset.x()), row + static_cast<int>(offset.y())},
                kFreeCell);
    }
  }
  return floor;
}

Result<OccupancyGrid> grid_of(const std::vector<Polygon>& shapes, const OccupancyGrid& floor) {
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid filled, fill_shapes(floor.geometry(), shapes));
  std::vector<std::int8_t> cells(floor.cells().begin(), floor.cells().end());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (filled.cells()[i] == kOccupiedCell) cells[i] = kOccupiedCell;
  }
  return OccupancyGrid::create(floor.geometry(), std::move(cells));
}

}  // namespace

Result<FootprintGrids> footprint_grids(const MapArchive& archive) {
  const Layer* layer = first_semantic_layer(archive);
  if (layer == nullptr) {
    return fail(ErrorCode::kNotFound, "the map has no class grids and no semantic layer");
  }
  FootprintGrids made{.layer = layer->info.name, .grids = {}};
  const ShapesByName shapes = shapes_by_name(*layer->content.as<SemanticLayer>());
  if (shapes.empty()) return made;
  const OccupancyGrid* occupancy = occupancy_in(archive, layer->info.frame_id);
  HYPERMAP_ASSIGN_OR_RETURN(
      const GridGeometry geometry,
      continued_around(
          occupancy != nullptr ? occupancy->geometry() : GridGeometry{.resolution_m = kPlainEdgeM},
          shapes));
  if (geometry.num_cells() * shapes.size() > kMaxFootprintCells) {
    return fail(ErrorCode::kLimit,
                std::to_string(shapes.size()) + " grids together have more than 2^30 cells");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid floor, seen_floor(geometry, occupancy));
  for (const auto& [name, polygons] : shapes) {
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid, grid_of(polygons, floor));
    made.grids.push_back(
        {.class_name = name, .frame_id = layer->info.frame_id, .grid = std::move(grid)});
  }
  return made;
}

}  // namespace hypermap
