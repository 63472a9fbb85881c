// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/low_obstacles.hpp"

#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/grids/rooms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using testing::SizeIs;

constexpr double kVoxelM = 0.1;

/// Space in voxels of 10 cm, all unknown at first, of which cuboids are set. Lengths in metres.
class DrawnSpace {
 public:
  DrawnSpace(double width_m, double depth_m, double height_m)
      : cols_(voxels(width_m)),
        rows_(voxels(depth_m)),
        floors_(voxels(height_m)),
        states_(cols_ * rows_ * floors_, 0) {}

  DrawnSpace& free(double x0, double y0, double z0, double x1, double y1, double z1) {
    return set(x0, y0, z0, x1, y1, z1, 1);
  }
  DrawnSpace& solid(double x0, double y0, double z0, double x1, double y1, double z1) {
    return set(x0, y0, z0, x1, y1, z1, 2);
  }

  [[nodiscard]] LeafSource leaves() const {
    return [this](const LeafVisitor& visit) {
      for (std::size_t i = 0; i < states_.size(); ++i) {
        if (states_[i] == 0) continue;
        const std::size_t row = i / cols_;
        const std::size_t level = row / rows_;
        const Eigen::Vector3d corner(static_cast<double>(i % cols_),
                                     static_cast<double>(row % rows_),
                                     static_cast<double>(level));
        visit({.centre_in_map = (corner.array() + 0.5) * kVoxelM,
               .edge_m = kVoxelM,
               .occupied = states_[i] == 2});
      }
    };
  }
  [[nodiscard]] OccupancyGrid occupancy() const { return project_occupancy(leaves()).value(); }
  [[nodiscard]] OccupancyGrid cleared(const LowObstacleOptions& options = {}) const {
    return without_low_obstacles(occupancy(), leaves(), options);
  }

 private:
  static std::size_t voxels(double m) { return static_cast<std::size_t>(std::lround(m / kVoxelM)); }

  DrawnSpace& set(
      double x0, double y0, double z0, double x1, double y1, double z1, std::uint8_t state) {
    for (std::size_t z = voxels(z0); z < voxels(z1); ++z) {
      for (std::size_t y = voxels(y0); y < voxels(y1); ++y) {
        for (std::size_t x = voxels(x0); x < voxels(x1); ++x) {
          states_[(z * rows_ + y) * cols_ + x] = state;
        }
      }
    }
    return *this;
  }

  std::size_t cols_;
  std::size_t rows_;
  std::size_t floors_;
  std::vector<std::uint8_t> states_;
};

/// A room of 4.2 m by 3 m within walls of 2 m, seen up to 1.8 m, in whose east a desk of 0.7 m and
/// 2.2 m length cuts a corner of 1.2 m off, which is open for 0.8 m. `top_m` is the desk's height.
DrawnSpace cut_corner(double top_m) {
  DrawnSpace space(4.4, 3.2, 2.0);
  space.solid(0, 0, 0, 4.4, 3.2, 2).free(0.1, 0.1, 0.1, 4.3, 3.1, 1.8);
  space.solid(2.5, 0.1, 0.1, 3.1, 2.3, top_m);
  return space;
}

TEST(LowObstacles, ADeskThatWasLookedOverPartsNoRoom) {
  const DrawnSpace desk = cut_corner(0.7);
  EXPECT_THAT(find_rooms(desk.occupancy()).rooms, SizeIs(2)) << "by what stands in the way";
  const RoomPlan plan = find_rooms(desk.cleared());
  ASSERT_THAT(plan.rooms, SizeIs(1));
  EXPECT_NEAR(plan.rooms[0].area_m2, 4.2 * 3.0, 1e-9) << "the desk stands on the floor";
}

TEST(LowObstacles, WhatReachesUpIsAWall) {
  EXPECT_THAT(find_rooms(cut_corner(1.8).cleared()).rooms, SizeIs(2));
  EXPECT_THAT(find_rooms(cut_corner(1.4).cleared()).rooms, SizeIs(2)) << "a top at its height, too";
  EXPECT_THAT(find_rooms(cut_corner(1.4).cleared({.wall_m = 1.5})).rooms, SizeIs(1));
}

TEST(LowObstacles, HeightsAreOverTheFloor) {
  const DrawnSpace desk = cut_corner(0.7);
  const LeafSource below = [&](const LeafVisitor& visit) {
    desk.leaves()([&](LeafSample leaf) {
      leaf.centre_in_map.z() -= 1.3;
      visit(leaf);
    });
  };
  const MapFloor floor{.height_m = -1.3};
  EXPECT_EQ(without_low_obstacles(desk.occupancy(), below, {.floor = floor}), desk.cleared());
  EXPECT_EQ(without_low_obstacles(desk.occupancy(), below), desk.occupancy())
      << "over z = 0 nothing is 1.4 m high";
}

TEST(LowObstacles, WhatNobodyLookedOverMayReachUp) {
  // A wall of which a camera that looked down saw the lowest 70 cm, and nothing above.
  DrawnSpace low_view = cut_corner(0.7);
  DrawnSpace unseen(4.4, 3.2, 2.0);
  unseen.solid(0, 0, 0, 4.4, 3.2, 2).free(0.1, 0.1, 0.1, 2.5, 3.1, 1.8);
  unseen.free(3.1, 0.1, 0.1, 4.3, 3.1, 1.8).free(2.5, 2.3, 0.1, 3.1, 3.1, 1.8);
  EXPECT_THAT(find_rooms(unseen.cleared()).rooms, SizeIs(2)) << "all of it is a wall";
  EXPECT_THAT(find_rooms(low_view.cleared({.min_free_share = 1.0})).rooms, SizeIs(1));
}

TEST(LowObstacles, HalfOfTheHeightAboveATopMustBeKnown) {
  // Between its top at 0.6 m and 1.4 m there are 0.8 m; of these 0.3 m are too few, 0.4 m enough.
  const auto seen_to = [](double z) {
    DrawnSpace column(0.3, 0.3, 2.0);
    column.free(0, 0, 0.1, 0.1, 0.3, 1.8).free(0.2, 0, 0.1, 0.3, 0.3, 1.8);
    column.solid(0.1, 0.1, 0.1, 0.2, 0.2, 0.6).free(0.1, 0.1, 0.6, 0.2, 0.2, z);
    return column.cleared().at({.col = 1, .row = 1});
  };
  EXPECT_EQ(seen_to(0.9), kOccupiedCell);
  EXPECT_EQ(seen_to(1.0), kFreeCell);
}

TEST(LowObstacles, FreeSpaceBelowATopSaysNothing) {
  // Under a table of 0.7 m was looked, over it never.
  DrawnSpace table(0.3, 0.3, 2.0);
  table.free(0, 0, 0, 0.3, 0.3, 0.6).solid(0.1, 0.1, 0.6, 0.2, 0.2, 0.7);
  EXPECT_EQ(table.cleared().at({.col = 1, .row = 1}), kOccupiedCell);
}

TEST(LowObstacles, OtherCellsStayAsTheyAre) {
  // What the grid alone calls occupied, unknown or free: a stranger's mark, a lintel above a door.
  DrawnSpace door(0.3, 0.1, 2.0);
  door.free(0, 0, 0.1, 0.3, 0.1, 1.8).solid(0.2, 0, 1.5, 0.3, 0.1, 2.0);
  OccupancyGrid grid = door.occupancy();
  grid.set({.col = 0, .row = 0}, kOccupiedCell);
  grid.set({.col = 1, .row = 0}, kUnknownCell);
  EXPECT_EQ(without_low_obstacles(grid, door.leaves()), grid);
}

TEST(LowObstacles, OptionsAreHeldInTheirRanges) {
  EXPECT_TRUE(validate(LowObstacleOptions{}).has_value());
  EXPECT_EQ(validate(LowObstacleOptions{.wall_m = 0}).error().field, "wall_m");
  EXPECT_EQ(validate(LowObstacleOptions{.min_free_share = 0}).error().field, "min_free_share");
}

}  // namespace
}  // namespace hypermap
