// SPDX-License-Identifier: BSD-3-Clause
// Long because: plans worked by hand, and the same questions answered by brute force, are read side
// by side.
#include "hypermap/projection/grids/free_space.hpp"

#include "drawn_plan.hpp"
#include "grids/grid_search.hpp"
#include "hypermap/core/base/random_numbers.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::drawn_plan;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

FreeSpace space_of(const OccupancyGrid& grid, double robot_radius_m = 0.0) {
  return FreeSpace::create(grid, robot_radius_m).value();
}

std::size_t place_at(const FreeSpace& space, int col, int row) {
  return space.geometry().index({col, row});
}

Polygon rectangle_of(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}).value();
}

std::vector<std::size_t> reaching(const FreeSpace& space, const Polygon& shape, double reach_m) {
  return places_to_reach(space, {&shape, 1}, reach_m).value();
}

TEST(FreeSpace, APlaceSaysWhyNoRobotMayBeThere) {
  const FreeSpace space = space_of(drawn_plan({".......",  //
                                               ".......",
                                               "...#...",
                                               ".......",
                                               "....?.."}),
                                   1.0);
  EXPECT_EQ(space.standing(Eigen::Vector2d(3.5, 2.5)), Standing::kOccupied);
  EXPECT_EQ(space.standing(Eigen::Vector2d(4.5, 0.5)), Standing::kUnknown);
  EXPECT_EQ(space.standing(Eigen::Vector2d(7.5, 0.5)), Standing::kOutside);
  // Half a metre to the edge of the obstacle.
  EXPECT_EQ(space.standing(Eigen::Vector2d(2.5, 2.5)), Standing::kTooNarrow);
  // A metre and a half to it, and to the grid's edge.
  EXPECT_EQ(space.standing(Eigen::Vector2d(1.5, 2.5)), Standing::kFits);
  EXPECT_EQ(space.standing(Eigen::Vector2d(0.5, 2.5)), Standing::kTooNarrow) << "the grid's edge";
}

// Three free cells of 0.1 m between walls: the middle is 0.15 m from either.
TEST(FreeSpace, AGapIsAsWideAsItsCells) {
  const OccupancyGrid grid = drawn_plan({"#######",  //
                                         ".......",
                                         ".......",
                                         ".......",
                                         "#######"},
                                        0.1);
  EXPECT_TRUE(space_of(grid, 0.15).fits({3, 2}));
  EXPECT_FALSE(space_of(grid, 0.151).fits({3, 2}));
  EXPECT_FALSE(space_of(grid, 0.15).fits({3, 3}));
}

TEST(FreeSpace, UnknownCellsAreNoObstacleButNotEntered) {
  const FreeSpace space = space_of(drawn_plan({".....",  //
                                               ".....",
                                               "..?..",
                                               ".....",
                                               "....."}),
                                   1.0);
  EXPECT_FALSE(space.fits({2, 2}));
  EXPECT_TRUE(space.fits({1, 2}));
  EXPECT_TRUE(space.is_within_radius({1, 2}, Standing::kUnknown));
  EXPECT_FALSE(space.is_within_radius({1, 2}, Standing::kOccupied));
}

// From (0.5, 0.5) around the wall to the cell (4, 0): up to row 3, over, down. The pulled way goes
// by the cells beside the wall's end: (0,0) to (1,3), (3,3), (4,0): 2 root 10 + 2.
TEST(FreeSpaceRoutes, TheWayLeadsAroundAWall) {
  const FreeSpace space = space_of(drawn_plan({".....",  //
                                               "..#..",
                                               "..#..",
                                               "..#.."}));
  const std::vector<std::vector<std::size_t>> goals{{place_at(space, 4, 0)}};
  const auto routes = routes_to_nearest(space, {0.5, 0.5}, goals, 1);
  ASSERT_THAT(routes, SizeIs(1));
  EXPECT_EQ(routes[0].goal, 0U);
  EXPECT_THAT(routes[0].route.points,
              ElementsAre(Eigen::Vector2d(0.5, 0.5),
                          Eigen::Vector2d(1.5, 3.5),
                          Eigen::Vector2d(3.5, 3.5),
                          Eigen::Vector2d(4.5, 0.5)));
  EXPECT_NEAR(routes[0].route.length_m, 2.0 * std::sqrt(10.0) + 2.0, 1e-12);
  EXPECT_EQ(routes[0].route.beside_unknown_m, 0.0);
}

// The goal behind the wall is 4 m away by the straight line and farther by the way than the one at
// 5 m in the open.
TEST(FreeSpaceRoutes, TheNearestIsToldByTheWayNotByTheLine) {
  const FreeSpace space = space_of(drawn_plan({"..........",  //
                                               "......#...",
                                               "......#...",
                                               "......#...",
                                               "......#...",
                                               "......#..."}));
  const std::vector<std::vector<std::size_t>> goals{{place_at(space, 8, 0)},
                                                    {place_at(space, 0, 3)}};
  const Eigen::Vector2d start(4.5, 0.5);
  const auto nearest = routes_to_nearest(space, start, goals, 1);
  ASSERT_THAT(nearest, SizeIs(1));
  EXPECT_EQ(nearest[0].goal, 1U);
  EXPECT_NEAR(nearest[0].route.length_m, 5.0, 1e-12);
  const auto both = routes_to_nearest(space, start, goals, 2);
  ASSERT_THAT(both, SizeIs(2));
  EXPECT_EQ(both[0], nearest[0]);
  EXPECT_EQ(both[1].goal, 0U);
  EXPECT_GT(both[1].route.length_m, 10.0);
}

TEST(FreeSpaceRoutes, WhereTheRobotIsThereIsNoWayToGo) {
  const FreeSpace space = space_of(drawn_plan({"...", "..."}));
  const std::vector<std::vector<std::size_t>> goals{{}, {place_at(space, 0, 0)}};
  const auto routes = routes_to_nearest(space, {0.2, 0.7}, goals, 5);
  ASSERT_THAT(routes, SizeIs(1));
  EXPECT_EQ(routes[0].goal, 1U);
  EXPECT_THAT(routes[0].route.points, ElementsAre(Eigen::Vector2d(0.2, 0.7)));
  EXPECT_EQ(routes[0].route.length_m, 0.0);
}

TEST(FreeSpaceRoutes, NoWayLeadsThroughAWallOrBetweenCorners) {
  const FreeSpace walled = space_of(drawn_plan({"..#..", "..#.."}));
  EXPECT_THAT(
      routes_to_nearest(
          walled, {0.5, 0.5}, std::vector<std::vector<std::size_t>>{{place_at(walled, 4, 0)}}, 1),
      IsEmpty());
  const FreeSpace corners = space_of(drawn_plan({"#.", ".#"}));
  EXPECT_THAT(
      routes_to_nearest(
          corners, {0.5, 0.5}, std::vector<std::vector<std::size_t>>{{place_at(corners, 1, 1)}}, 1),
      IsEmpty());
}

// Along row 0 the cells of columns 3 to 5 have the unknown cell of column 4 within 1 m.
TEST(FreeSpaceRoutes, WhatLiesBesideUnknownSpaceIsTold) {
  const FreeSpace space = space_of(drawn_plan({".........",  //
                                               "....?....",
                                               ".........",
                                               "........."}),
                                   0.5);
  const std::vector<std::vector<std::size_t>> goals{{place_at(space, 7, 1)}};
  const auto routes = routes_to_nearest(space, {1.5, 1.5}, goals, 1);
  ASSERT_THAT(routes, SizeIs(1));
  EXPECT_NEAR(routes[0].route.length_m, 6.0, 1e-12);
  // Nearer than half a metre to the edge of the unknown cell is none of them.
  EXPECT_EQ(routes[0].route.beside_unknown_m, 0.0);
  const FreeSpace wide = space_of(drawn_plan({".........",  //
                                              ".........",
                                              "....?....",
                                              ".........",
                                              ".........",
                                              "........."}),
                                  1.0);
  const auto beside = routes_to_nearest(
      wide, {1.5, 2.5}, std::vector<std::vector<std::size_t>>{{place_at(wide, 7, 2)}}, 1);
  ASSERT_THAT(beside, SizeIs(1));
  // Seven looks over 6 m; those at columns 3, 4 and 5 are less than 1.5 m from its middle.
  EXPECT_NEAR(beside[0].route.beside_unknown_m, 6.0 * 3.0 / 7.0, 1e-12);
}

// A box in the middle of a hall: the robot of half a metre comes as near as a free cell between.
TEST(PlacesToReach, AreThoseNearestToTheFootprint) {
  std::vector<std::string> rows(9, std::string(9, '.'));
  rows[4][4] = '#';
  const FreeSpace space = space_of(drawn_plan(rows), 1.0);
  const Polygon box = rectangle_of({4.0, 4.0}, {5.0, 5.0});
  const auto places = reaching(space, box, 0.5);
  // The nearest cells that fit are two columns away, 1.5 m from the footprint, which is within
  // radius and reach; at their sides (2, 3) and (2, 5), root 5 - 0.5 from it, are too far.
  EXPECT_THAT(places,
              ElementsAre(place_at(space, 4, 2),
                          place_at(space, 2, 4),
                          place_at(space, 6, 4),
                          place_at(space, 4, 6)));
  EXPECT_THAT(reaching(space, box, 0.4), IsEmpty()) << "1.4 m are too short an arm";
  EXPECT_THAT(reaching(space, rectangle_of({40, 40}, {41, 41}), 0.5), IsEmpty())
      << "far outside the grid";
}

// Behind the wall the robot would be 0.45 m from the shape, in front of it 0.15 m.
TEST(PlacesToReach, AThingAtAWallIsReachedFromItsOwnSide) {
  std::vector<std::string> rows(20, std::string(40, '.'));
  for (std::string& row : rows) row[20] = row[21] = '#';
  const FreeSpace space = space_of(drawn_plan(rows, 0.1), 0.15);
  const Polygon poster = rectangle_of({1.91, 0.91}, {1.99, 1.09});
  const auto places = reaching(space, poster, 0.5);
  ASSERT_FALSE(places.empty());
  for (const std::size_t place : places) EXPECT_LT(place % 40, 20U);
}

/// The least that a step to the cell from one of its neighbours comes to.
double least_by_a_step(const FreeSpace& space, const std::vector<double>& cells, Cell to) {
  double least = std::numeric_limits<double>::infinity();
  for (int dr = -1; dr <= 1; ++dr) {
    for (int dc = -1; dc <= 1; ++dc) {
      const Cell from{to.col + dc, to.row + dr};
      if (!space.fits(from) || !space.fits({to.col, from.row}) || !space.fits({from.col, to.row})) {
        continue;
      }
      least = std::min(least, cells[space.geometry().index(from)] + std::hypot(dc, dr));
    }
  }
  return least;
}

/// By distances that are lowered until none can be.
std::vector<double> distances_by_brute_force(const FreeSpace& space, Cell start) {
  const GridGeometry& grid = space.geometry();
  std::vector<double> cells(grid.num_cells(), std::numeric_limits<double>::infinity());
  cells[grid.index(start)] = 0.0;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t place = 0; place < cells.size(); ++place) {
      const Cell cell{static_cast<int>(place) % grid.cols, static_cast<int>(place) / grid.cols};
      if (!space.fits(cell)) continue;
      const double by_a_step = least_by_a_step(space, cells, cell);
      if (by_a_step >= cells[place] - 1e-9) continue;
      cells[place] = by_a_step;
      has_changed = true;
    }
  }
  return cells;
}

OccupancyGrid cluttered_plan(CounterRng& rng) {
  const GridGeometry geometry{.resolution_m = 0.1,
                              .origin = {-0.7, 0.3},
                              .yaw_rad = rng.uniform(-1.0, 1.0),
                              .cols = static_cast<int>(5 + rng.below(20)),
                              .rows = static_cast<int>(5 + rng.below(20))};
  std::vector<std::int8_t> cells;
  for (std::size_t i = 0; i < geometry.num_cells(); ++i) {
    cells.push_back(rng.chance(0.75) ? kFreeCell : rng.chance(0.7) ? kOccupiedCell : kUnknownCell);
  }
  return OccupancyGrid::create(geometry, cells).value();
}

std::optional<Cell> any_fitting(const FreeSpace& space) {
  for (int row = 0; row < space.geometry().rows; ++row) {
    for (int col = 0; col < space.geometry().cols; ++col) {
      if (space.fits({col, row})) return Cell{col, row};
    }
  }
  return std::nullopt;
}

TEST(GridSearch, DistancesAreThoseOfBruteForce) {
  for (int seed = 0; seed < test::repetitions(40); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 2);
    const FreeSpace space = space_of(cluttered_plan(rng));
    const auto start = any_fitting(space);
    if (!start) continue;
    std::vector<double> cells(space.geometry().num_cells(),
                              std::numeric_limits<double>::infinity());
    double before = 0.0;
    const GridSearch search(space, *start, [&](std::size_t place, double distance) {
      EXPECT_GE(distance, before);
      before = cells[place] = distance;
      return true;
    });
    const auto expected = distances_by_brute_force(space, *start);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!std::isfinite(expected[i])) {
        ASSERT_FALSE(std::isfinite(cells[i])) << seed;
        continue;
      }
      ASSERT_NEAR(cells[i], expected[i], 1e-9) << seed;
      double length = 0.0;
      const auto way = search.way_to(i);
      for (std::size_t k = 1; k < way.size(); ++k) {
        length += std::hypot(way[k].col - way[k - 1].col, way[k].row - way[k - 1].row);
      }
      ASSERT_NEAR(length, expected[i], 1e-9) << seed;
    }
  }
}

TEST(GridSearch, AStraightLineIsFreeWhereAllThatItCrossesIs) {
  for (int seed = 0; seed < test::repetitions(60); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 3);
    const FreeSpace space = space_of(cluttered_plan(rng));
    const auto any_cell = [&] {
      return Cell{static_cast<int>(rng.below(static_cast<std::uint32_t>(space.geometry().cols))),
                  static_cast<int>(rng.below(static_cast<std::uint32_t>(space.geometry().rows)))};
    };
    for (int k = 0; k < 20; ++k) {
      const Cell from = any_cell();
      const Cell to = any_cell();
      // Points of the line, each with what lies within rounding of it.
      bool is_free = true;
      for (int i = 0; i <= 4000; ++i) {
        const double x = from.col + 0.5 + (to.col - from.col) * i / 4000.0;
        const double y = from.row + 0.5 + (to.row - from.row) * i / 4000.0;
        for (const double dx : {-1e-6, 1e-6}) {
          for (const double dy : {-1e-6, 1e-6}) {
            const Cell cell{static_cast<int>(std::floor(x + dx)),
                            static_cast<int>(std::floor(y + dy))};
            is_free = is_free && space.fits(cell);
          }
        }
      }
      // 4,000 points of at most 25 cells may miss a cell that the line only just touches.
      const bool is_straight = is_straight_free(space, from, to);
      EXPECT_TRUE(is_free || !is_straight) << seed;
      EXPECT_EQ(is_straight, is_straight_free(space, to, from)) << seed;
    }
  }
}

TEST(FreeSpaceRoutes, AWayIsFreeAndNoShorterThanTheLine) {
  for (int seed = 0; seed < test::repetitions(40); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 4);
    const FreeSpace space = space_of(cluttered_plan(rng), seed % 3 == 0 ? 0.05 : 0.0);
    const auto start = any_fitting(space);
    if (!start) continue;
    const Eigen::Vector2d from = centre(space.geometry(), *start);
    std::vector<std::vector<std::size_t>> goals;
    for (std::size_t place = 0; place < space.geometry().num_cells(); place += 7) {
      goals.push_back({place});
    }
    const auto expected = distances_by_brute_force(space, *start);
    const auto routes = routes_to_nearest(space, from, goals, goals.size());
    const auto is_connected = [&](const auto& goal) { return std::isfinite(expected[goal[0]]); };
    EXPECT_EQ(static_cast<std::ptrdiff_t>(routes.size()),
              std::ranges::count_if(goals, is_connected));
    double before_m = 0.0;
    for (const RouteToGoal& one : routes) {
      const auto& points = one.route.points;
      EXPECT_GE(one.route.length_m, before_m);
      before_m = one.route.length_m;
      EXPECT_GE(one.route.length_m, (points.back() - from).norm() - 1e-9);
      EXPECT_LE(one.route.length_m, expected[goals[one.goal][0]] * 0.1 + 1e-9);
      EXPECT_LE(one.route.beside_unknown_m, one.route.length_m + 1e-9);
      for (std::size_t i = 1; i < points.size(); ++i) {
        for (int k = 0; k <= 50; ++k) {
          const Eigen::Vector2d at = points[i - 1] + k / 50.0 * (points[i] - points[i - 1]);
          EXPECT_EQ(space.standing(at), Standing::kFits) << seed;
        }
      }
    }
  }
}

TEST(ApproachOptions, AreHeldToTheirRanges) {
  EXPECT_TRUE(validate(ApproachOptions{}));
  EXPECT_EQ(validate(ApproachOptions{.robot_radius_m = -0.1}).error().field, "robot_radius_m");
  EXPECT_EQ(validate(ApproachOptions{.reach_m = std::nan("")}).error().field, "reach_m");
}

}  // namespace
}  // namespace hypermap
