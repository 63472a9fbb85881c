// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/rooms.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

constexpr std::size_t kNoDoor = std::numeric_limits<std::size_t>::max();

/// How to get to a doorway from where one starts.
struct WayToDoor {
  double length_m = std::numeric_limits<double>::infinity();
  std::size_t before = kNoDoor;
};

bool is_of(const Doorway& door, RoomNumber room) {
  return door.from == room || door.to == room;
}

/// To each doorway, from the middle of a room straight from doorway to doorway.
std::vector<WayToDoor> ways_to_doors(const RoomPlan& plan, RoomNumber from) {
  const std::vector<Doorway>& doors = plan.doorways;
  std::vector<WayToDoor> ways(doors.size());
  for (std::size_t i = 0; i < doors.size(); ++i) {
    if (!is_of(doors[i], from)) continue;
    ways[i].length_m = (doors[i].position - plan.rooms[from - 1].middle).norm();
  }
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < doors.size(); ++i) {
      for (std::size_t j = 0; j < doors.size(); ++j) {
        if (!is_of(doors[j], doors[i].from) && !is_of(doors[j], doors[i].to)) continue;
        const double length_m = ways[i].length_m + (doors[j].position - doors[i].position).norm();
        if (!(length_m < ways[j].length_m)) continue;
        ways[j] = {.length_m = length_m, .before = i};
        has_changed = true;
      }
    }
  }
  return ways;
}

/// The rows or columns from `middle - reach` to `middle + reach`, as far as there are any.
struct CellRange {
  CellRange(double middle, double reach, int size)
      : begin(static_cast<int>(std::clamp(middle - reach - 1.0, 0.0, static_cast<double>(size)))),
        end(static_cast<int>(std::clamp(middle + reach + 1.0, 0.0, static_cast<double>(size)))) {}
  int begin;
  int end;
};

}  // namespace

RoomNumber room_at(const RoomPlan& plan, const Eigen::Vector2d& point, double reach_m) {
  const GridGeometry& geometry = plan.geometry;
  if (const auto cell = cell_at(geometry, point)) {
    if (const RoomNumber room = plan.cells[geometry.index(*cell)]; room != kNoRoom) return room;
  }
  const Eigen::Vector2d middle = to_cells(geometry, point);
  const double reach = reach_m / geometry.resolution_m;
  const CellRange rows(middle.y(), reach, geometry.rows);
  const CellRange cols(middle.x(), reach, geometry.cols);
  RoomNumber nearest = kNoRoom;
  double nearest_cells2 = reach * reach;
  for (int row = rows.begin; row < rows.end; ++row) {
    for (int col = cols.begin; col < cols.end; ++col) {
      const RoomNumber room = plan.cells[geometry.index({col, row})];
      const double cells2 = (Eigen::Vector2d(col + 0.5, row + 0.5) - middle).squaredNorm();
      const bool is_nearer =
          nearest == kNoRoom ? cells2 <= nearest_cells2 : cells2 < nearest_cells2;
      if (room == kNoRoom || !is_nearer) continue;
      nearest = room;
      nearest_cells2 = cells2;
    }
  }
  return nearest;
}

std::optional<std::vector<Doorway>> doorways_between(const RoomPlan& plan,
                                                     RoomNumber from,
                                                     RoomNumber to) {
  if (from == to) return std::vector<Doorway>();
  const std::vector<WayToDoor> ways = ways_to_doors(plan, from);
  std::size_t last = kNoDoor;
  double shortest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (!is_of(plan.doorways[i], to)) continue;
    const double length_m =
        ways[i].length_m + (plan.doorways[i].position - plan.rooms[to - 1].middle).norm();
    if (!(length_m < shortest_m)) continue;
    shortest_m = length_m;
    last = i;
  }
  if (last == kNoDoor) return std::nullopt;
  std::vector<Doorway> way;
  for (std::size_t i = last; i != kNoDoor; i = ways[i].before) way.push_back(plan.doorways[i]);
  std::ranges::reverse(way);
  return way;
}

}  // namespace hypermap
