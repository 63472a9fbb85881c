// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a round robot may be on an occupancy grid, and the way from one place to others.
///
/// Source: [hypermap] chapter 6 (a robot that is to find the nearest object of a class). Ours: the
/// nearest one is told by the way along free space, not by the straight line.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {

struct OptionTable;

struct ApproachOptions {
  /// The robot is a disc of this radius.
  double robot_radius_m = 0.25;
  /// It has arrived where an object's footprint is so far from its rim at most: about an arm's
  /// length, as a cup on a table is reached from the table's edge.
  double reach_m = 0.5;
  friend bool operator==(const ApproachOptions&, const ApproachOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range.
[[nodiscard]] Result<void> validate(const ApproachOptions& options);
[[nodiscard]] const OptionTable& option_table(const ApproachOptions& options);

/// Whether a robot may be at a place, and if not, why.
enum class Standing : std::uint8_t {
  kFits,
  kOutside,    ///< Beyond the grid.
  kUnknown,    ///< Nobody saw whether the place is free.
  kOccupied,   ///< Its middle is in an obstacle.
  kTooNarrow,  ///< Free, but an obstacle, or the grid's edge, is nearer than the robot's radius.
};

/// The cells where the middle of a round robot may be. A value.
///
/// Free are cells of 0 to 49, occupied those of 50 on. The middle stays on free cells, and the disc
/// keeps off what is occupied and off the grid's edge; unknown cells are never entered by the
/// middle and are no obstacle to the disc, as what nobody saw need not be a wall.
/// `FreeSpaceRoute::beside_unknown_m` says where that matters. Lengths are exact to one cell.
class FreeSpace {
 public:
  /// Requires: robot_radius_m >= 0 and finite. Errors: kOutOfMemory. Cost: O(cells).
  [[nodiscard]] static Result<FreeSpace> create(const OccupancyGrid& grid, double robot_radius_m);

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] double robot_radius_m() const noexcept { return robot_radius_m_; }
  [[nodiscard]] Standing standing(const Eigen::Vector2d& point) const;
  /// Requires: the cell is in the grid.
  [[nodiscard]] Standing standing(Cell cell) const { return cells_[geometry_.index(cell)]; }
  [[nodiscard]] bool fits(Cell cell) const {
    return geometry_.contains(cell) && standing(cell) == Standing::kFits;
  }
  /// Whether a cell of that kind lies nearer to the middle of `cell` than the robot's radius.
  /// Cost: the cells within the radius.
  [[nodiscard]] bool is_within_radius(Cell cell, Standing kind) const;

 private:
  FreeSpace(const GridGeometry& geometry, double robot_radius_m, std::vector<Standing> cells)
      : geometry_(geometry), robot_radius_m_(robot_radius_m), cells_(std::move(cells)) {}

  GridGeometry geometry_;
  double robot_radius_m_;
  std::vector<Standing> cells_;
};

/// The places, in row-major order, from which a robot reaches a footprint: those nearest to it, to
/// a tenth of a metre or two cells, where any is within the robot's radius and `reach_m`. So a
/// thing at a wall is reached from its own side. Boundary: empty when it can be reached from
/// nowhere. Errors: kLimit when more than 2^28 cells would have to be looked at; kOutOfMemory.
/// Frame: the grid's. Cost: the cells within twice radius and reach around it.
[[nodiscard]] Result<std::vector<std::size_t>> places_to_reach(const FreeSpace& space,
                                                               std::span<const Polygon> footprint,
                                                               double reach_m);

/// A way that a robot can follow.
struct FreeSpaceRoute {
  /// Straight from one to the next; the start and the end included. Frame: the grid's.
  std::vector<Eigen::Vector2d> points;
  double length_m = 0.0;
  /// So much of it has unknown cells within the robot's radius.
  double beside_unknown_m = 0.0;
  friend bool operator==(const FreeSpaceRoute&, const FreeSpaceRoute&) = default;
};

/// A route to one of several goals.
struct RouteToGoal {
  std::size_t goal = 0;  ///< Its place among those that were asked for.
  FreeSpaceRoute route;
  friend bool operator==(const RouteToGoal&, const RouteToGoal&) = default;
};

/// The ways to the `count` goals that are nearest along free space, the shortest way first, of
/// equally long ones that to the first goal. A goal is a set of places (`places_to_reach`), and the
/// way ends at the first of them that it comes to; goals that no way leads to are left out.
///
/// Shortest over the cells' eight neighbours (Dijkstra; no corner is cut), then pulled straight
/// wherever the line crosses no cell that the robot does not fit. Which goal is nearest goes by the
/// length of the pulled way.
/// Requires: standing(start) is kFits; goals ascending. Boundary: a start that is a place of a goal
/// has a way of one point and no length. Cost: O(n log n) for the n cells up to the last goal;
/// memory 9 bytes a cell of the grid.
[[nodiscard]] std::vector<RouteToGoal> routes_to_nearest(
    const FreeSpace& space,
    const Eigen::Vector2d& start,
    std::span<const std::vector<std::size_t>> goals,
    std::size_t count);

}  // namespace hypermap
