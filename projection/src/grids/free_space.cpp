// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/free_space.hpp"

#include "grids/clearance.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/projection/grids/near_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// Rounding of a radius in cells decides nothing.
constexpr double kRounding = 1e-9;
/// Places that are so much farther from a footprint than the nearest one will do, too.
constexpr double kGenerousM = 0.1;
constexpr double kGenerousCells = 2.0;

constexpr OptionRow kApproachRows[] = {
    option::number<&ApproachOptions::robot_radius_m>(
        "robot_radius_m", {0, 10}, {.unit = "m", .effect = "The robot is a disc of this radius."}),
    option::number<&ApproachOptions::reach_m>(
        "reach_m",
        {0, 10},
        {.unit = "m",
         .effect = "It has arrived where an object's footprint is so far from its rim at most."}),
};

Standing state_of(std::int8_t occupancy) {
  if (occupancy == kUnknownCell) return Standing::kUnknown;
  return occupancy >= kLeastBlocked ? Standing::kOccupied : Standing::kFits;
}

/// As places_to_reach; what a library throws is thrown.
Result<std::vector<std::size_t>> near_places(const FreeSpace& space,
                                             std::span<const Polygon> footprint,
                                             double reach_m) {
  const GridGeometry& grid = space.geometry();
  const double most = (space.robot_radius_m() + reach_m) / grid.resolution_m;
  std::vector<std::pair<std::size_t, double>> near;
  double nearest = most;
  HYPERMAP_TRY(for_each_near_cell(grid, footprint, most, [&](Cell cell, double gap) {
    if (!space.fits(cell)) return;
    near.emplace_back(grid.index(cell), gap);
    nearest = std::min(nearest, gap);
  }));
  const double enough = nearest + std::max(kGenerousM / grid.resolution_m, kGenerousCells);
  std::vector<std::size_t> places;
  places.reserve(near.size());
  for (const auto& [place, gap] : near) {
    if (gap <= enough) places.push_back(place);
  }
  return places;
}

}  // namespace

const OptionTable& option_table(const ApproachOptions&) {
  static constexpr OptionTable kTable{kApproachRows};
  return kTable;
}

Result<void> validate(const ApproachOptions& options) {
  return check_options(options);
}

Result<FreeSpace> FreeSpace::create(const OccupancyGrid& grid, double robot_radius_m) {
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&]() -> Result<FreeSpace> {
    const GridGeometry& geometry = grid.geometry();
    CellMask open{.cols = geometry.cols, .rows = geometry.rows, .is_in = {}};
    std::vector<Standing> cells;
    cells.reserve(geometry.num_cells());
    open.is_in.reserve(geometry.num_cells());
    for (const std::int8_t occupancy : grid.cells()) {
      cells.push_back(state_of(occupancy));
      open.is_in.push_back(cells.back() == Standing::kOccupied ? 0 : 1);
    }
    const std::vector<std::int64_t> clearance = squared_clearance(open);
    const double radius_cells = robot_radius_m / geometry.resolution_m - kRounding;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] != Standing::kFits) continue;
      if (gap_in_cells(clearance[i]) < radius_cells) cells[i] = Standing::kTooNarrow;
    }
    return FreeSpace(geometry, robot_radius_m, std::move(cells));
  });
}

Standing FreeSpace::standing(const Eigen::Vector2d& point) const {
  const auto cell = cell_at(geometry_, point);
  return cell ? standing(*cell) : Standing::kOutside;
}

bool FreeSpace::is_within_radius(Cell cell, Standing kind) const {
  const double reach = robot_radius_m_ / geometry_.resolution_m + 0.5;
  const double size = std::max(geometry_.cols, geometry_.rows);
  const int span = static_cast<int>(std::min(reach, size));
  for (int row = std::max(0, cell.row - span); row <= std::min(geometry_.rows - 1, cell.row + span);
       ++row) {
    for (int col = std::max(0, cell.col - span);
         col <= std::min(geometry_.cols - 1, cell.col + span);
         ++col) {
      if (standing(Cell{col, row}) != kind) continue;
      if (std::hypot(col - cell.col, row - cell.row) < reach) return true;
    }
  }
  return false;
}

Result<std::vector<std::size_t>> places_to_reach(const FreeSpace& space,
                                                 std::span<const Polygon> footprint,
                                                 double reach_m) {
  return guarded(ErrorCode::kInvalidArgument, "the footprint", [&] {
    return near_places(space, footprint, reach_m);
  });
}

}  // namespace hypermap
