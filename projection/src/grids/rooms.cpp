// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/rooms.hpp"

#include "grids/cell_neighbours.hpp"
#include "grids/clearance.hpp"
#include "grids/room_regions.hpp"
#include "hypermap/core/base/option_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Less than that of a cell may be a wall's.
constexpr double kCoveredShare = 0.5;

constexpr OptionRow kRoomRows[] = {
    option::number<&RoomOptions::doorway_m>(
        "doorway_m",
        option::above(0, 100),
        {.unit = "m", .effect = "Wider gaps part no rooms: doors are narrower."}),
    option::number<&RoomOptions::passage_share>(
        "passage_share",
        option::above(0, 1),
        {.effect = "A gap narrower than this share of both rooms' widest places parts them."}),
    option::number<&RoomOptions::max_gap_share>(
        "max_gap_share",
        option::above(0, 1),
        {.effect = "So does one narrower than this share of a near place of either room."}),
    option::number<&RoomOptions::doorway_depth_m>(
        "doorway_depth_m",
        option::above(0, 100),
        {.unit = "m", .effect = "How near to the gap that place is: as deep as walls are."}),
    option::number<&RoomOptions::min_width_m>(
        "min_width_m", {0, 100}, {.unit = "m", .effect = "What is nowhere so wide is no room."}),
    option::number<&RoomOptions::min_room_m2>(
        "min_room_m2",
        {0, 10000},
        {.unit = "m2", .effect = "Smaller rooms are niches of a neighbour, or nothing."}),
    option::number<&RoomOptions::max_island_m2>(
        "max_island_m2",
        {0, 10000},
        {.unit = "m2", .effect = "Smaller things alone on the floor are no walls."}),
    option::number<&RoomOptions::max_island_m>(
        "max_island_m",
        {0, 100},
        {.unit = "m", .effect = "Longer things that are thin, too, are walls all the same."}),
    option::number<&RoomOptions::min_island_m>(
        "min_island_m",
        {0, 100},
        {.unit = "m", .effect = "Mean thickness from which on long things are no walls."}),
};

/// A part of what is not free whose cells share edges or corners.
struct Island {
  std::vector<std::size_t> cells;
  int min_col = 0, max_col = 0, min_row = 0, max_row = 0;
  bool touches_edge = false;
};

Island island_from(std::size_t start, const CellMask& floor, std::vector<std::uint8_t>& is_done) {
  const auto width = static_cast<std::size_t>(floor.cols);
  Island island{
      .cells = {start}, .min_col = floor.cols, .max_col = -1, .min_row = floor.rows, .max_row = -1};
  is_done[start] = 1;
  for (std::size_t next = 0; next < island.cells.size(); ++next) {
    const int row = static_cast<int>(island.cells[next] / width);
    const int col = static_cast<int>(island.cells[next] % width);
    island.min_col = std::min(island.min_col, col);
    island.max_col = std::max(island.max_col, col);
    island.min_row = std::min(island.min_row, row);
    island.max_row = std::max(island.max_row, row);
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, floor.rows - 1); ++r) {
      for (int c = std::max(col - 1, 0); c <= std::min(col + 1, floor.cols - 1); ++c) {
        const std::size_t cell = static_cast<std::size_t>(r) * width + static_cast<std::size_t>(c);
        if (floor.is_in[cell] != 0 || is_done[cell] != 0) continue;
        is_done[cell] = 1;
        island.cells.push_back(cell);
      }
    }
  }
  island.touches_edge = island.min_col == 0 || island.min_row == 0 ||
                        island.max_col == floor.cols - 1 || island.max_row == floor.rows - 1;
  return island;
}

bool is_wall(const Island& island, double resolution_m, const RoomOptions& options) {
  const double area_m2 = static_cast<double>(island.cells.size()) * resolution_m * resolution_m;
  if (island.touches_edge || area_m2 > options.max_island_m2) return true;
  const double length_m = resolution_m * std::hypot(island.max_col - island.min_col + 1,
                                                    island.max_row - island.min_row + 1);
  return length_m > options.max_island_m && area_m2 / length_m < options.min_island_m;
}

/// The free cells, and islands among them that are no walls.
CellMask floor_of(const OccupancyGrid& grid, const RoomOptions& options) {
  const GridGeometry& geometry = grid.geometry();
  CellMask floor{.cols = geometry.cols, .rows = geometry.rows, .is_in = {}};
  floor.is_in.reserve(geometry.num_cells());
  for (const std::int8_t value : grid.cells()) {
    floor.is_in.push_back(value >= kFreeCell && value < kLeastBlocked ? 1 : 0);
  }
  std::vector<std::uint8_t> is_done(floor.is_in.size(), 0);
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < floor.is_in.size(); ++i) {
    if (floor.is_in[i] != 0 || is_done[i] != 0) continue;
    const Island island = island_from(i, floor, is_done);
    if (is_wall(island, geometry.resolution_m, options)) continue;
    filled.insert(filled.end(), island.cells.begin(), island.cells.end());
  }
  for (const std::size_t cell : filled) floor.is_in[cell] = 1;
  return floor;
}

/// The floor and what is unknown: all that no wall is seen in.
CellMask unblocked(const OccupancyGrid& grid, const CellMask& floor) {
  CellMask open = floor;
  for (std::size_t i = 0; i < open.is_in.size(); ++i) {
    if (grid.cells()[i] == kUnknownCell) open.is_in[i] = 1;
  }
  return open;
}

Cell cell_of_place(const GridGeometry& geometry, std::size_t place) {
  const auto cols = static_cast<std::size_t>(geometry.cols);
  return {.col = static_cast<int>(place % cols), .row = static_cast<int>(place / cols)};
}

/// Regions as rooms, the largest first.
RoomPlan plan_of(const RoomRegions& regions, const GridGeometry& geometry) {
  std::vector<std::size_t> order(regions.num_cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return regions.num_cells[a] > regions.num_cells[b];
  });
  RoomPlan plan{.geometry = geometry, .cells = {}, .rooms = {}, .doorways = {}};
  std::vector<RoomNumber> number_of(order.size());
  plan.rooms.reserve(order.size());
  for (const std::size_t region : order) {
    const auto number = static_cast<RoomNumber>(plan.rooms.size() + 1);
    number_of[region] = number;
    plan.rooms.push_back(
        {.number = number,
         .area_m2 = static_cast<double>(regions.num_cells[region]) * geometry.resolution_m *
                    geometry.resolution_m,
         .middle = centre(geometry, cell_of_place(geometry, regions.widest[region]))});
  }
  plan.cells.reserve(regions.cells.size());
  for (const std::uint32_t region : regions.cells) {
    plan.cells.push_back(region == kNoRegion ? kNoRoom : number_of[region]);
  }
  return plan;
}

/// Cells of the lower room of a pair that touch the other one, by pair.
using Borders = std::map<std::pair<RoomNumber, RoomNumber>, std::set<std::size_t>>;

Borders borders_of(const RoomPlan& plan) {
  Borders borders;
  for (std::size_t i = 0; i < plan.cells.size(); ++i) {
    const RoomNumber here = plan.cells[i];
    if (here == kNoRoom) continue;
    for_each_neighbour(plan.geometry.cols, plan.geometry.rows, i, [&](std::size_t next) {
      if (plan.cells[next] > here) borders[{here, plan.cells[next]}].insert(i);
    });
  }
  return borders;
}

/// The places of one doorway: cells of a border that share edges or corners, `border` loses them.
std::vector<std::size_t> take_doorway(std::set<std::size_t>& border, const GridGeometry& geometry) {
  std::vector<std::size_t> cells{*border.begin()};
  border.erase(border.begin());
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const Cell at = cell_of_place(geometry, cells[next]);
    for (int row = at.row - 1; row <= at.row + 1; ++row) {
      for (int col = at.col - 1; col <= at.col + 1; ++col) {
        if (!geometry.contains({col, row})) continue;
        const auto found = border.find(geometry.index({col, row}));
        if (found == border.end()) continue;
        cells.push_back(*found);
        border.erase(found);
      }
    }
  }
  return cells;
}

std::vector<Doorway> doorways_of(const RoomPlan& plan, const std::vector<std::int64_t>& clearance) {
  std::vector<Doorway> doorways;
  for (auto& [rooms, border] : borders_of(plan)) {
    std::set<std::size_t> left = border;
    while (!left.empty()) {
      const std::vector<std::size_t> cells = take_doorway(left, plan.geometry);
      const std::size_t middle = *std::ranges::max_element(
          cells, [&](std::size_t a, std::size_t b) { return clearance[a] < clearance[b]; });
      doorways.push_back({.from = rooms.first,
                          .to = rooms.second,
                          .position = centre(plan.geometry, cell_of_place(plan.geometry, middle)),
                          .width_m = gap_width_m(clearance[middle], plan.geometry.resolution_m)});
    }
  }
  return doorways;
}

/// Calls `visit(cell)` for each cell that one of the polygons covers by half.
template <class Visit>
void for_each_half_covered(const GridGeometry& geometry,
                           std::span<const Polygon> obstacles,
                           Visit visit) {
  for (const Polygon& obstacle : obstacles) {
    for_each_covered_cell(geometry, obstacle, [&](Cell cell, double covered) {
      if (covered >= kCoveredShare) visit(cell);
    });
  }
}

}  // namespace

const OptionTable& option_table(const RoomOptions&) {
  static constexpr OptionTable kTable{kRoomRows};
  return kTable;
}

Result<void> validate(const RoomOptions& options) {
  return check_options(options);
}

OccupancyGrid without_obstacles(OccupancyGrid grid, std::span<const Polygon> obstacles) {
  for_each_half_covered(grid.geometry(), obstacles, [&](Cell cell) { grid.set(cell, kFreeCell); });
  return grid;
}

OccupancyGrid with_obstacles(OccupancyGrid grid, std::span<const Polygon> obstacles) {
  for_each_half_covered(grid.geometry(), obstacles, [&](Cell cell) {
    const std::int8_t value = grid.at(cell);
    const bool is_free = value >= kFreeCell && value < kLeastBlocked;
    if (is_free) grid.set(cell, kOccupiedCell);
  });
  return grid;
}

RoomPlan find_rooms(const OccupancyGrid& grid, const RoomOptions& options) {
  const GridGeometry& geometry = grid.geometry();
  const CellMask floor = floor_of(grid, options);
  const std::vector<std::int64_t> clearance = squared_clearance(unblocked(grid, floor));
  const double cell_m2 = geometry.resolution_m * geometry.resolution_m;
  const auto min_cells = static_cast<std::size_t>(std::ceil(options.min_room_m2 / cell_m2));
  RoomRegions regions = flood_regions(floor, clearance, geometry.resolution_m, options);
  regions = without_niches(std::move(regions), floor, clearance, min_cells);
  RoomPlan plan = plan_of(regions, geometry);
  plan.doorways = doorways_of(plan, clearance);
  return plan;
}

}  // namespace hypermap
