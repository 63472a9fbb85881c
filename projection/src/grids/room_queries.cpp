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
  double cost = std::numeric_limits<double>::infinity();
  std::size_t before = kNoDoor;
};

bool is_of(const Doorway& door, RoomNumber room) {
  return door.from == room || door.to == room;
}

double metre_cost(const RoomCost& cost, RoomNumber room) {
  return cost ? cost(room) : 1.0;
}

/// Of the straight way between two doorways, in the cheapest room that both are of; none when
/// there is no such room.
std::optional<double> cost_between(const Doorway& a, const Doorway& b, const RoomCost& cost) {
  std::optional<double> least;
  for (const RoomNumber room : {a.from, a.to}) {
    if (!is_of(b, room)) continue;
    const double of_room = metre_cost(cost, room) * (b.position - a.position).norm();
    least = std::min(of_room, least.value_or(of_room));
  }
  return least;
}

/// To each doorway, from the middle of a room straight from doorway to doorway.
std::vector<WayToDoor> ways_to_doors(const RoomPlan& plan, RoomNumber from, const RoomCost& cost) {
  const std::vector<Doorway>& doors = plan.doorways;
  std::vector<WayToDoor> ways(doors.size());
  for (std::size_t i = 0; i < doors.size(); ++i) {
    if (!is_of(doors[i], from)) continue;
    ways[i].cost =
        metre_cost(cost, from) * (doors[i].position - plan.rooms[from - 1].middle).norm();
  }
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < doors.size(); ++i) {
      for (std::size_t j = 0; j < doors.size(); ++j) {
        const auto step = cost_between(doors[i], doors[j], cost);
        if (!step || !(ways[i].cost + *step < ways[j].cost)) continue;
        ways[j] = {.cost = ways[i].cost + *step, .before = i};
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
                                                     RoomNumber to,
                                                     const RoomCost& cost) {
  if (from == to) return std::vector<Doorway>();
  const std::vector<WayToDoor> ways = ways_to_doors(plan, from, cost);
  std::size_t last = kNoDoor;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (!is_of(plan.doorways[i], to)) continue;
    const double whole =
        ways[i].cost +
        metre_cost(cost, to) * (plan.doorways[i].position - plan.rooms[to - 1].middle).norm();
    if (!(whole < least)) continue;
    least = whole;
    last = i;
  }
  if (last == kNoDoor) return std::nullopt;
  std::vector<Doorway> way;
  for (std::size_t i = last; i != kNoDoor; i = ways[i].before) way.push_back(plan.doorways[i]);
  std::ranges::reverse(way);
  return way;
}

}  // namespace hypermap
