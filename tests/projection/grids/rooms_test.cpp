// SPDX-License-Identifier: BSD-3-Clause
// Long because: plans of rooms that are told apart are read side by side.
#include "hypermap/projection/grids/rooms.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kCellM = 0.05;

/// A grid with walls all over, of which rectangles are freed. Lengths in metres.
class Plan {
 public:
  Plan(double width_m, double height_m)
      : grid_(
            OccupancyGrid::create({.resolution_m = kCellM,
                                   .origin = {-1, -1},
                                   .cols = static_cast<int>(std::lround((width_m + 2) / kCellM)),
                                   .rows = static_cast<int>(std::lround((height_m + 2) / kCellM))},
                                  kOccupiedCell)
                .value()) {}

  Plan& set(double x0, double y0, double x1, double y1, std::int8_t value) {
    const auto cells = [](double m) { return static_cast<int>(std::lround((m + 1) / kCellM)); };
    for (int row = cells(y0); row < cells(y1); ++row) {
      for (int col = cells(x0); col < cells(x1); ++col) grid_.set({col, row}, value);
    }
    return *this;
  }
  Plan& free(double x0, double y0, double x1, double y1) { return set(x0, y0, x1, y1, kFreeCell); }
  Plan& wall(double x0, double y0, double x1, double y1) {
    return set(x0, y0, x1, y1, kOccupiedCell);
  }

  [[nodiscard]] OccupancyGrid& grid() { return grid_; }
  [[nodiscard]] RoomPlan rooms(const RoomOptions& options = {}) const {
    return find_rooms(grid_, options);
  }

 private:
  OccupancyGrid grid_;
};

/// A room of 4 m by 3 m and one of 3 m by 3 m, a wall of 0.1 m between them with a door of 0.9 m.
Plan two_rooms() {
  Plan plan(7.1, 3);
  plan.free(0, 0, 4, 3).free(4.1, 0, 7.1, 3).free(4, 1, 4.1, 1.9);
  return plan;
}

RoomNumber at(const RoomPlan& plan, double x, double y) {
  return room_at(plan, {x, y}, 0.0);
}

TEST(FindRooms, NothingKnownIsNoRoom) {
  EXPECT_THAT(find_rooms(OccupancyGrid()).rooms, IsEmpty());
  Plan unknown(3, 3);
  unknown.set(-1, -1, 4, 4, kUnknownCell);
  EXPECT_THAT(unknown.rooms().rooms, IsEmpty());
  EXPECT_THAT(Plan(3, 3).rooms().rooms, IsEmpty());
}

TEST(FindRooms, ADoorPartsTwoRooms) {
  const RoomPlan plan = two_rooms().rooms();
  ASSERT_THAT(plan.rooms, SizeIs(2));
  EXPECT_EQ(at(plan, 2, 1.5), 1U) << "the larger one";
  EXPECT_EQ(at(plan, 6, 1.5), 2U);
  EXPECT_NEAR(plan.rooms[0].area_m2 + plan.rooms[1].area_m2, 12 + 9 + 0.09, 1e-9);
  EXPECT_NEAR(plan.rooms[0].area_m2, 12, 0.1);
  ASSERT_THAT(plan.doorways, SizeIs(1));
  EXPECT_EQ(plan.doorways[0].from, 1U);
  EXPECT_EQ(plan.doorways[0].to, 2U);
  EXPECT_NEAR(plan.doorways[0].width_m, 0.9, kCellM + 1e-9);
  EXPECT_NEAR(plan.doorways[0].position.x(), 4.05, 0.15);
  EXPECT_NEAR(plan.doorways[0].position.y(), 1.45, 0.051);
}

TEST(FindRooms, AWideOpeningPartsNothing) {
  Plan plan = two_rooms();
  plan.free(4, 1, 4.1, 2.3);
  EXPECT_THAT(plan.rooms().rooms, SizeIs(1));
  EXPECT_THAT(plan.rooms({.doorway_m = 1.5}).rooms, SizeIs(2)) << "unless doors are so wide";
}

TEST(FindRooms, AnOpenDoubleDoorPartsTwoRooms) {
  Plan plan = two_rooms();
  plan.free(4, 1, 4.1, 2.2);
  const RoomPlan found = plan.rooms();
  ASSERT_THAT(found.rooms, SizeIs(2));
  ASSERT_THAT(found.doorways, SizeIs(1));
  EXPECT_NEAR(found.doorways[0].width_m, 1.2, kCellM + 1e-9);
}

TEST(FindRooms, ThickWallsAndPassagesPartTheirRoomsToo) {
  // A door of 0.9 m in a wall of 0.5 m, and a passage of 0.9 m that is 2 m long: no room itself.
  for (const double depth_m : {0.5, 2.0}) {
    Plan plan(7 + depth_m, 3);
    plan.free(0, 0, 4, 3).free(4 + depth_m, 0, 7 + depth_m, 3).free(4, 1, 4 + depth_m, 1.9);
    EXPECT_THAT(plan.rooms().rooms, SizeIs(2)) << depth_m;
    EXPECT_THAT(plan.rooms().doorways, SizeIs(1)) << depth_m;
  }
}

TEST(FindRooms, ClosedRoomsHaveNoDoorway) {
  Plan plan(7.1, 3);
  plan.free(0, 0, 4, 3).free(4.1, 0, 7.1, 3);
  EXPECT_THAT(plan.rooms().rooms, SizeIs(2));
  EXPECT_THAT(plan.rooms().doorways, IsEmpty());
  EXPECT_EQ(doorways_between(plan.rooms(), 1, 2), std::nullopt);
}

TEST(FindRooms, AnLShapeIsOneRoom) {
  Plan plan(6, 6);
  plan.free(0, 0, 6, 2).free(0, 0, 2, 6);
  EXPECT_THAT(plan.rooms().rooms, SizeIs(1));
}

TEST(FindRooms, ACorridorIsARoomOfItsOwn) {
  // 1.2 m wide and 8 m long, with a room on either side.
  Plan plan(8, 6);
  plan.free(0, 2.5, 8, 3.7);
  plan.free(0, 0, 4, 2.4).free(1, 2.4, 1.85, 2.5);
  plan.free(3, 3.8, 8, 6).free(6, 3.7, 6.85, 3.8);
  const RoomPlan found = plan.rooms();
  ASSERT_THAT(found.rooms, SizeIs(3));
  const RoomNumber corridor = at(found, 0.3, 3.1);
  EXPECT_EQ(at(found, 7.7, 3.1), corridor);
  EXPECT_NE(at(found, 2, 1), corridor);
  const auto way = doorways_between(found, at(found, 2, 1), at(found, 5, 5));
  ASSERT_TRUE(way.has_value());
  ASSERT_THAT(*way, SizeIs(2)) << "through the corridor";
  EXPECT_NEAR((*way)[0].position.x(), 1.425, 0.1);
  EXPECT_NEAR((*way)[1].position.x(), 6.425, 0.1);
}

TEST(FindRooms, NoiseAlongACorridorIsNoRowOfDoors) {
  for (int seed = 0; seed < test::repetitions(8); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 1);
    Plan plan(10, 1.2);
    plan.free(0, 0, 10, 1.2);
    for (int i = 0; i < 60; ++i) {
      const double x = rng.uniform(0, 9.9);
      const bool is_low = rng.chance(0.5);
      plan.wall(x, is_low ? 0 : 1.15, x + 0.1, is_low ? 0.05 : 1.2);
    }
    EXPECT_THAT(plan.rooms().rooms, SizeIs(1)) << seed;
  }
}

TEST(FindRooms, ACorridorIsNotCutBetweenItsDoors) {
  // 1.2 m wide, with a door of 0.9 m to a room on either side at both ends; opposite doors make it
  // 1.5 m wide there (2 x hypot(0.6, 0.45)), and 10 cm of noise in between leave 1.1 m: 0.73 of it.
  Plan plan(8, 7.4);
  plan.free(0, 3.1, 8, 4.3);
  plan.free(0, 0, 3.9, 3).free(4.1, 0, 8, 3).free(0, 4.4, 3.9, 7.4).free(4.1, 4.4, 8, 7.4);
  for (const double x : {1.5, 5.6}) plan.free(x, 3, x + 0.9, 3.1).free(x, 4.3, x + 0.9, 4.4);
  plan.wall(3.8, 3.1, 4.2, 3.2);
  const RoomPlan found = plan.rooms();
  EXPECT_THAT(found.rooms, SizeIs(5));
  EXPECT_EQ(at(found, 0.3, 3.7), at(found, 7.7, 3.7));
  EXPECT_THAT(plan.rooms({.doorway_depth_m = 10}).rooms, SizeIs(6)) << "if doorways were so deep";
}

TEST(FindRooms, OpenPlanIsOneRoomWithItsPillarsTablesAndSpeckles) {
  Plan plan(8, 6);
  plan.free(0, 0, 8, 6);
  for (const double x : {2.0, 4.0, 6.0}) plan.wall(x, 3, x + 0.4, 3.4);
  plan.wall(1, 0.8, 3, 1.8);                 // a table, 0.8 m from the wall
  plan.set(5, 0.6, 6.6, 1.6, kUnknownCell);  // one that nobody looked into
  plan.wall(7, 5, 7.05, 5.05).set(0.5, 5, 0.55, 5.1, kUnknownCell);
  const RoomPlan found = plan.rooms();
  ASSERT_THAT(found.rooms, SizeIs(1));
  EXPECT_NEAR(found.rooms[0].area_m2, 48, 1e-9) << "furniture stands on the floor";
}

TEST(FindRooms, APartitionBetweenTwoDoorsIsAWall) {
  // The wall of 4 m has a door at either end, so that its middle of 2.2 m stands alone.
  Plan plan(6.1, 4);
  plan.free(0, 0, 3, 4).free(3.1, 0, 6.1, 4).free(3, 0, 3.1, 0.9).free(3, 3.1, 3.1, 4);
  const RoomPlan found = plan.rooms();
  ASSERT_THAT(found.rooms, SizeIs(2));
  EXPECT_THAT(found.doorways, SizeIs(2));
}

TEST(FindRooms, WhatNobodySawNarrowsNoGap) {
  // A hall of 3 m, of which only a strip of 0.8 m was seen in the middle of its length.
  Plan plan(8, 3);
  plan.free(0, 0, 8, 3).set(3.5, 0, 4.5, 1.1, kUnknownCell).set(3.5, 1.9, 4.5, 3, kUnknownCell);
  EXPECT_THAT(plan.rooms({.max_island_m2 = 0}).rooms, SizeIs(1));
  plan.wall(3.5, 0, 4.5, 1.1).wall(3.5, 1.9, 4.5, 3);
  EXPECT_THAT(plan.rooms({.max_island_m2 = 0}).rooms, SizeIs(2)) << "walls do";
}

TEST(FindRooms, ANicheIsPartOfItsRoom) {
  Plan plan(6, 4);
  plan.free(0, 0, 4, 4).free(4, 1, 4.6, 1.8);  // 0.6 m deep: too narrow for a room
  EXPECT_THAT(plan.rooms().rooms, SizeIs(1));
  Plan closet(7, 4);
  closet.free(0, 0, 4, 4).free(4, 1, 4.1, 1.7).free(4.1, 0.7, 5.25, 2.0);  // 1.5 m2 behind a door
  EXPECT_THAT(closet.rooms().rooms, SizeIs(2));
  const RoomPlan merged = closet.rooms({.min_room_m2 = 2.0});
  ASSERT_THAT(merged.rooms, SizeIs(1));
  EXPECT_EQ(at(merged, 4.6, 1.3), 1U);
  Plan alone(7, 4);
  alone.free(0, 0, 4, 4).free(5, 1, 5.4, 1.4);  // a leak of the sensor behind the wall
  EXPECT_THAT(alone.rooms().rooms, SizeIs(1));
  EXPECT_EQ(at(alone.rooms(), 5.2, 1.2), kNoRoom);
}

TEST(FindRooms, SpecklesBehindTheWallsAreNoRooms) {
  // 70,000 leaks of the sensor, one cell each.
  Plan plan(30, 30);
  for (int i = 0; i < 264; ++i) {
    for (int j = 0; j < 264; ++j) plan.free(0.1 * i, 0.1 * j, 0.1 * i + 0.05, 0.1 * j + 0.05);
  }
  plan.free(10, 10, 14, 14);
  const RoomPlan found = plan.rooms({.max_island_m2 = 0});
  ASSERT_THAT(found.rooms, SizeIs(1));
  EXPECT_NEAR(found.rooms[0].area_m2, 16, 0.2);
}

TEST(FindRooms, TheWholeIsTurnedAndShiftedWithItsGrid) {
  const RoomPlan straight = two_rooms().rooms();
  Plan base = two_rooms();
  const std::vector<std::int8_t> cells(base.grid().cells().begin(), base.grid().cells().end());
  GridGeometry geometry = base.grid().geometry();
  geometry.yaw_rad = 0.7;
  geometry.origin = {30, -20};
  const RoomPlan turned = find_rooms(OccupancyGrid::create(geometry, cells).value());
  EXPECT_EQ(turned.cells, straight.cells);
  const Eigen::Vector2d door =
      from_cells(geometry, to_cells(straight.geometry, straight.doorways[0].position));
  EXPECT_LT((turned.doorways[0].position - door).norm(), 1e-9);
}

/// Rooms of 3 m by 3 m in a grid of 4 x 3, doors of 0.8 m between all neighbours, seeds move them.
Plan floor_of_twelve(std::uint64_t seed) {
  CounterRng rng(seed, 2);
  Plan plan(4 * 3.1, 3 * 3.1);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double x = 3.1 * i;
      const double y = 3.1 * j;
      plan.free(x, y, x + 3, y + 3);
      const double to_x = x + rng.uniform(0, 2.2);
      const double to_y = y + rng.uniform(0, 2.2);
      if (j < 2) plan.free(to_x, y + 3, to_x + 0.8, y + 3.1);
      if (i < 3) plan.free(x + 3, to_y, x + 3.1, to_y + 0.8);
    }
  }
  return plan;
}

TEST(FindRooms, EachFreeCellOfALargeFloorIsInTheRoomThatItIsJoinedTo) {
  for (int seed = 0; seed < test::repetitions(4); ++seed) {
    const RoomPlan found = floor_of_twelve(static_cast<std::uint64_t>(seed)).rooms();
    ASSERT_THAT(found.rooms, SizeIs(12)) << seed;
    EXPECT_THAT(found.doorways, SizeIs(3 * 3 + 4 * 2)) << seed;
    std::set<RoomNumber> rooms;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 3; ++j) {
        const RoomNumber room = at(found, 3.1 * i + 1.5, 3.1 * j + 1.5);
        rooms.insert(room);
        for (const double dx : {0.1, 2.9}) {
          for (const double dy : {0.1, 2.9}) EXPECT_EQ(at(found, 3.1 * i + dx, 3.1 * j + dy), room);
        }
      }
    }
    EXPECT_THAT(rooms, SizeIs(12)) << seed;
  }
}

TEST(WithoutObstacles, FurnitureAlongTheWallPartsNothing) {
  // A wardrobe and a bed leave 0.8 m between them; a table stands on the rest.
  Plan plan(5, 3);
  plan.free(0, 0, 5, 3).wall(2, 2.4, 3, 3).wall(2, 0, 3, 1.6);
  ASSERT_THAT(plan.rooms().rooms, SizeIs(2));
  const auto box = [](double x0, double y0, double x1, double y1) {
    return make_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}).value();
  };
  const std::vector<Polygon> furniture{box(2, 2.4, 3, 3), box(2, 0, 3, 1.6)};
  const OccupancyGrid cleared = without_obstacles(plan.grid(), furniture);
  EXPECT_THAT(find_rooms(cleared).rooms, SizeIs(1));
  EXPECT_EQ(cleared.counts().free, 100U * 60U);
}

TEST(RoomAt, WhatIsInNoRoomBelongsToTheNearestWithinReach) {
  const RoomPlan plan = two_rooms().rooms();
  EXPECT_EQ(room_at(plan, {-0.2, 1.5}, 0.1), kNoRoom);
  EXPECT_EQ(room_at(plan, {-0.2, 1.5}, 0.5), 1U);
  EXPECT_EQ(room_at(plan, {7.3, 1.5}, 0.5), 2U);
  EXPECT_EQ(room_at(plan, {4.04, 2.5}, 0.3), 1U)
      << "in the wall, 4 cm from one and 6 from the other";
  EXPECT_EQ(room_at(plan, {1e6, -1e6}, 2.0), kNoRoom);
}

TEST(DoorwaysBetween, TheShorterWayOfTwo) {
  // Three rooms in a row and a corridor along all of them: 1 to 3 is shorter through 2.
  Plan plan(9.2, 5);
  plan.free(0, 0, 3, 3).free(3.1, 0, 6.1, 3).free(6.2, 0, 9.2, 3).free(0, 3.1, 9.2, 4.6);
  plan.free(3, 1, 3.1, 1.9).free(6.1, 1, 6.2, 1.9);  // 1 - 2 - 3
  plan.free(0, 3, 0.9, 3.1).free(8.3, 3, 9.2, 3.1);  // by the corridor
  const RoomPlan found = plan.rooms();
  ASSERT_THAT(found.rooms, SizeIs(4));
  const RoomNumber west = at(found, 1, 1);
  const RoomNumber east = at(found, 8, 1);
  const auto way = doorways_between(found, west, east);
  ASSERT_TRUE(way.has_value());
  ASSERT_THAT(*way, SizeIs(2));
  EXPECT_NEAR((*way)[0].position.y(), 1.45, 0.1);
  EXPECT_EQ(doorways_between(found, west, west), std::vector<Doorway>());
  // [smap] 3.5.1, traversability cost: where a metre of the room between costs 9, the corridor is
  // the way; 1.01 is too little for that.
  const RoomNumber middle = at(found, 4.5, 1);
  for (const auto& [metre_cost, y_m] : {std::pair(9.0, 3.05), std::pair(1.01, 1.45)}) {
    const auto cheapest =
        doorways_between(found, west, east, [&, cost = metre_cost](RoomNumber room) {
          return room == middle ? cost : 1.0;
        });
    ASSERT_TRUE(cheapest.has_value());
    ASSERT_THAT(*cheapest, SizeIs(2));
    EXPECT_NEAR((*cheapest)[0].position.y(), y_m, 0.1) << metre_cost;
  }
}

TEST(RoomOptions, AreHeldInTheirRanges) {
  EXPECT_TRUE(validate(RoomOptions{}).has_value());
  EXPECT_EQ(validate(RoomOptions{.doorway_m = 0}).error().field, "doorway_m");
  EXPECT_EQ(validate(RoomOptions{.passage_share = 1.1}).error().field, "passage_share");
  EXPECT_EQ(validate(RoomOptions{.doorway_depth_m = 0}).error().field, "doorway_depth_m");
}

}  // namespace
}  // namespace hypermap
