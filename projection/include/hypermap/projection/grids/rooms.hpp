// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which parts of the free floor are rooms, and the doorways between them.
///
/// Ours: [smap] 3.5.1 knows places along the robot's way alone. A room is a part of the free floor
/// that is joined to others through gaps narrower than a doorway only. Watershed of the clearance
/// (distance to what is not free) with regions that merge by their persistence: L. Vincent and
/// P. Soille, "Watersheds in digital spaces", 1991; H. Edelsbrunner et al., "Topological
/// persistence and simplification", 2002.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

struct RoomOptions {
  /// Wider gaps part nothing. Above the clear width of doors, single (0.6 to 1 m) and double (1.2
  /// m).
  double doorway_m = 1.25;
  /// Narrower ones part rooms when they are narrower than this share of the widest place of both
  /// ...
  double passage_share = 0.6;
  /// ... or than this share of a place of either room ...
  double max_gap_share = 0.8;
  /// ... that is so near to the gap, along rows and along columns: a doorway is as deep as a wall.
  /// What is a little narrower for longer is a corridor, and noise along it is no row of doors.
  double doorway_depth_m = 0.8;
  double min_width_m = 1.1;    ///< What is nowhere so wide is no room: a passage, a niche.
  double min_room_m2 = 1.0;    ///< Smaller ones are niches of a neighbour, or nothing.
  double max_island_m2 = 4.0;  ///< What stands alone in the free floor and is smaller is no wall.
  double max_island_m = 1.0;   ///< But longer and thin (`min_island_m`) it is one.
  double min_island_m = 0.3;   ///< Mean thickness of an island, if it is long.
  friend bool operator==(const RoomOptions&, const RoomOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range.
[[nodiscard]] Result<void> validate(const RoomOptions& options);
[[nodiscard]] const OptionTable& option_table(const RoomOptions& options);

/// Rooms are called 1, 2 and so on; 0 is no room.
using RoomNumber = std::uint32_t;
inline constexpr RoomNumber kNoRoom = 0;

struct Room {
  RoomNumber number = kNoRoom;
  double area_m2 = 0.0;  ///< Free floor, furniture that was taken for floor included.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< Where it is widest, inside it.
  friend bool operator==(const Room&, const Room&) = default;
};

/// A gap between two rooms, `from` < `to`.
struct Doorway {
  RoomNumber from = kNoRoom;
  RoomNumber to = kNoRoom;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< The middle of its narrowest part.
  double width_m = 0.0;                                ///< To one cell.
  friend bool operator==(const Doorway&, const Doorway&) = default;
};

/// The rooms of a grid. A value. Unit: metre. Frame: that of the grid.
struct RoomPlan {
  GridGeometry geometry;
  std::vector<RoomNumber> cells;  ///< Row-major, row 0 = min y; kNoRoom where no room is.
  std::vector<Room> rooms;        ///< By number, the largest first.
  std::vector<Doorway> doorways;  ///< Ascending by rooms, then by row and column.
  friend bool operator==(const RoomPlan&, const RoomPlan&) = default;
};

/// The occupancy with the cells free that one of the polygons covers by half: furniture is no wall.
/// Source: [smap] F.6 (occupancy grid with the obstacles removed). Cost: as for_each_covered_cell.
[[nodiscard]] OccupancyGrid without_obstacles(OccupancyGrid grid,
                                              std::span<const Polygon> obstacles);

/// The occupancy with the free cells occupied that one of the polygons covers by half: something
/// stands there, whatever rays passed through its column. Unknown ones stay.
/// Cost: as for_each_covered_cell.
[[nodiscard]] OccupancyGrid with_obstacles(OccupancyGrid grid, std::span<const Polygon> obstacles);

/// Free are cells of 0 to 49. What is not known is in no room, but only what is occupied narrows a
/// gap: where nobody looked there need not be a wall.
///
/// Parts of what is not free that lie alone in the free floor, do not reach the grid's edge and are
/// small (`max_island_m2`) are pillars, furniture and noise and count as free, unless they are long
/// and thin as a partition is.
/// Boundary: nothing free, no rooms. A gap is as wide as its cells are, to one cell.
/// Requires: validate(options). Cost: O(n log n) for n cells, and where a gap is hardly narrower
/// than its rooms the cells within a doorway's depth; memory 40 bytes a cell.
[[nodiscard]] RoomPlan find_rooms(const OccupancyGrid& grid, const RoomOptions& options = {});

/// The room at a point; else, of the cells within `reach_m`, that of the nearest one; else kNoRoom.
/// Of equally near cells the first by row and column. Requires: finite.
/// Cost: the cells within reach.
[[nodiscard]] RoomNumber room_at(const RoomPlan& plan,
                                 const Eigen::Vector2d& point,
                                 double reach_m);

/// What a metre of way costs in a room, > 0; empty: 1 in every room.
using RoomCost = std::function<double(RoomNumber)>;

/// The doorways on the cheapest way from one room to another, straight from doorway to doorway, in
/// order; empty from a room to itself; none when no way is known. Requires: rooms of the plan.
/// Source: [smap] 3.5.1 (traversability cost of places). Cost: O(doorways^2) for each doorway on
/// the longest way.
[[nodiscard]] std::optional<std::vector<Doorway>> doorways_between(const RoomPlan& plan,
                                                                   RoomNumber from,
                                                                   RoomNumber to,
                                                                   const RoomCost& cost = {});

}  // namespace hypermap
