// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/class_grids.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace hypermap {
namespace {

constexpr std::size_t kMaxCellsInAll = std::size_t{1} << 30U;

std::set<ClassId> classes_in(const LeafSource& leaves,
                             const HeightBand& band,
                             const GridGeometry& geometry) {
  std::set<ClassId> classes;
  leaves([&](const LeafSample& leaf) {
    if (!leaf.occupied || !leaf.best_class || classes.count(*leaf.best_class) != 0) return;
    for_each_column(
        geometry, band, leaf, [&](Cell /*cell*/, double /*covered*/, double /*height*/) {
          classes.insert(*leaf.best_class);
        });
  });
  return classes;
}

/// A grid for each class in which nothing of the class stands yet.
Result<std::map<ClassId, OccupancyGrid>> empty_grids(const OccupancyGrid& occupancy,
                                                     const std::set<ClassId>& classes) {
  if (classes.size() * occupancy.cells().size() > kMaxCellsInAll) {
    return fail(ErrorCode::kLimit,
                std::to_string(classes.size()) + " grids together have more than 2^30 cells",
                "resolution_m");
  }
  std::vector<std::int8_t> cells(occupancy.cells().begin(), occupancy.cells().end());
  std::replace(cells.begin(), cells.end(), kOccupiedCell, kFreeCell);
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid nothing,
                            OccupancyGrid::create(occupancy.geometry(), std::move(cells)));
  std::map<ClassId, OccupancyGrid> grids;
  for (const ClassId id : classes) grids.emplace(id, nothing);
  return grids;
}

}  // namespace

Result<std::vector<ClassColumns>> project_class_grids(const LeafSource& leaves,
                                                      const HeightBand& band,
                                                      const OccupancyProjectionOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid occupancy,
                            project_occupancy(leaves, band, options));
  const GridGeometry& geometry = occupancy.geometry();
  const std::set<ClassId> classes = classes_in(leaves, band, geometry);
  HYPERMAP_ASSIGN_OR_RETURN(auto grids, empty_grids(occupancy, classes));
  leaves([&](const LeafSample& leaf) {
    if (!leaf.occupied || !leaf.best_class) return;
    for_each_column(geometry, band, leaf, [&](Cell cell, double /*covered*/, double /*height*/) {
      grids.at(*leaf.best_class).set(cell, kOccupiedCell);
    });
  });
  std::vector<ClassColumns> out;
  for (auto& [id, grid] : grids) out.push_back({id, std::move(grid)});
  return out;
}

Result<OccupancyGrid> fill_shapes(const GridGeometry& geometry,
                                  std::span<const Polygon> shapes,
                                  double min_covered) {
  if (!(min_covered >= 0.0 && min_covered <= 1.0)) {
    return fail(ErrorCode::kInvalidArgument, "must be in [0, 1]", "min_covered");
  }
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid grid, OccupancyGrid::create(geometry, kFreeCell));
  constexpr double kRounding = 1e-9;
  for (const Polygon& shape : shapes) {
    for_each_covered_cell(geometry, shape, [&](Cell cell, double covered) {
      if (covered >= min_covered - kRounding) grid.set(cell, kOccupiedCell);
    });
  }
  return grid;
}

}  // namespace hypermap
