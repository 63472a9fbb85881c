// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/floor_surface.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

constexpr MilliLogOdds kHit = 847;
constexpr MilliLogOdds kMiss = -405;

/// Voxels of 10 cm, put together from blocks; what is put later replaces what was there.
class Blocks {
 public:
  /// Voxels [from, to) on each axis, counted from the map's origin.
  Blocks& put(const Eigen::Vector3i& from,
              const Eigen::Vector3i& to,
              MilliLogOdds log_odds,
              ObjectId object = kNoObject) {
    for (int x = from.x(); x < to.x(); ++x) {
      for (int y = from.y(); y < to.y(); ++y) {
        for (int z = from.z(); z < to.z(); ++z) {
          const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + x),
                             static_cast<std::uint16_t>(kOriginKey + y),
                             static_cast<std::uint16_t>(kOriginKey + z)};
          StoredLeaf leaf{.key = key, .log_odds = log_odds};
          if (object != kNoObject) leaf.label.emplace().vote(object);
          EXPECT_TRUE(octree_.set_leaf(leaf));
        }
      }
    }
    return *this;
  }

  [[nodiscard]] std::optional<double> floor_m() const {
    return floor_surface_m(octree_, leaf_source(octree_));
  }
  /// Of what lies at x >= 0.
  [[nodiscard]] std::optional<double> floor_beyond_zero_m() const {
    return floor_surface_m(octree_, [this](const LeafVisitor& visit) {
      octree_.for_each_leaf([&](const LeafSample& leaf) {
        if (leaf.centre_in_map.x() >= 0.0) visit(leaf);
      });
    });
  }

  /// Around a sensor in the middle of the room.
  [[nodiscard]] std::optional<double> floor_below_m(double sensor_height_m) const {
    return hypermap::floor_below_m(octree_, PointInMap{{1.5, 1.5, sensor_height_m}});
  }

 private:
  SemanticOctree octree_ = SemanticOctree::create({.resolution_m = 0.1}).value();
};

/// A room of 3 x 3 x 2 m whose floor is the level of voxels `z`.
Blocks room(int z) {
  Blocks blocks;
  blocks.put({0, 0, z}, {30, 30, z + 1}, kHit).put({0, 0, z + 1}, {30, 30, z + 20}, kMiss);
  return blocks;
}

TEST(FloorSurface, IsTheMiddleOfItsVoxels) {
  EXPECT_NEAR(room(0).floor_m().value(), 0.05, 1e-9);
  EXPECT_NEAR(room(-14).floor_m().value(), -1.35, 1e-9);
  EXPECT_NEAR(room(1'200).floor_m().value(), 120.05, 1e-9);
}

TEST(FloorSurface, NoiseOfAVoxelIsAveraged) {
  Blocks noisy = room(-1);
  noisy.put({0, 0, 0}, {15, 30, 1}, kHit);  // half of it one level higher
  EXPECT_NEAR(noisy.floor_m().value(), 0.0, 1e-9);
}

TEST(FloorSurface, TablesAndShelvesAreHigher) {
  Blocks furnished = room(0);
  furnished.put(
      {0, 0, 7}, {30, 28, 8}, kHit);  // a table top, larger than what is seen of the floor
  EXPECT_NEAR(furnished.floor_m().value(), 0.05, 1e-9);
}

TEST(FloorSurface, SmallPartsBelowAreNone) {
  Blocks with_reflection = room(0);
  with_reflection.put({0, 0, -12}, {5, 5, -11}, kHit).put({0, 0, -11}, {5, 5, -8}, kMiss);
  EXPECT_NEAR(with_reflection.floor_m().value(), 0.05, 1e-9);
}

TEST(FloorSurface, ATableTopOverWhatWasSeenFreeIsNone) {
  Blocks table;
  table.put({0, 0, 0}, {20, 12, 1}, kHit).put({0, 0, 1}, {20, 12, 10}, kMiss);
  EXPECT_TRUE(table.floor_m());
  table.put({20, 0, -6}, {30, 12, 10}, kMiss);  // beside it, 0.72 m^3 below its top
  EXPECT_FALSE(table.floor_m());
}

TEST(FloorSurface, OfLessThanTwoSquareMetresIsNone) {
  Blocks small;
  small.put({0, 0, 0}, {20, 9, 1}, kHit).put({0, 0, 1}, {20, 9, 10}, kMiss);
  EXPECT_FALSE(small.floor_m());
  small.put({0, 9, 0}, {20, 10, 1}, kHit).put({0, 9, 1}, {20, 10, 10}, kMiss);
  EXPECT_TRUE(small.floor_m());
}

TEST(FloorSurface, OfAPartIsItsOwn) {
  Blocks two = room(0);
  two.put({-40, 0, -20}, {-10, 30, -19}, kHit).put({-40, 0, -19}, {-10, 30, -10}, kMiss);
  EXPECT_NEAR(two.floor_m().value(), -1.95, 1e-9);
  EXPECT_NEAR(two.floor_beyond_zero_m().value(), 0.05, 1e-9);
}

TEST(FloorSurface, WhatIsNotSeenFreeAboveIsNoFloor) {
  Blocks solid;
  solid.put({0, 0, -3}, {30, 30, 1}, kHit);
  EXPECT_FALSE(solid.floor_m());
  EXPECT_FALSE(Blocks().floor_m());
}

TEST(FloorBelow, IsWhatLinesDownMeetFirst) {
  EXPECT_NEAR(room(0).floor_below_m(1.25).value(), 0.05, 1e-9);
  EXPECT_NEAR(room(-14).floor_below_m(0.0).value(), -1.35, 1e-9);
  EXPECT_FALSE(room(-40).floor_below_m(0.0)) << "3.9 m below";
  EXPECT_FALSE(Blocks().floor_below_m(1.25)) << "nothing is known";
}

TEST(FloorBelow, IsUnderTheTables) {
  Blocks furnished = room(0);
  furnished.put({0, 0, 7}, {25, 30, 8}, kHit);  // all but a strip of half a metre
  EXPECT_NEAR(furnished.floor_below_m(1.25).value(), 0.05, 1e-9);
  EXPECT_NEAR(furnished.floor_below_m(0.45).value(), 0.05, 1e-9) << "from below the tops";
  furnished.put({25, 0, 7}, {29, 30, 8}, kHit).put({29, 0, 7}, {30, 11, 8}, kHit);  // 12 are left
  EXPECT_NEAR(furnished.floor_below_m(1.25).value(), 0.05, 1e-9);
  furnished.put({29, 11, 7}, {30, 13, 8}, kHit);  // 11
  EXPECT_NEAR(furnished.floor_below_m(1.25).value(), 0.75, 1e-9);
}

TEST(FloorBelow, IsNoObject) {
  Blocks bed;
  bed.put({0, 0, 4}, {30, 30, 5}, kHit, ObjectId{7});
  EXPECT_FALSE(bed.floor_below_m(1.25));
  bed.put({0, 0, 4}, {30, 2, 5}, kHit);
  EXPECT_NEAR(bed.floor_below_m(1.25).value(), 0.45, 1e-9) << "a rim of no object";
}

TEST(FloorBelow, EndsWithTheVolumeAndInsideWhatIsOccupied) {
  EXPECT_FALSE(room(0).floor_below_m(0.05)) << "the sensor is in the floor";
  const SemanticOctree octree = SemanticOctree::create({.resolution_m = 0.1}).value();
  EXPECT_FALSE(floor_below_m(octree, PointInMap{{4000.0, 0.0, -4000.0}}));
}

TEST(FloorBelow, IsTheLowerOfTwoLevels) {
  Blocks step = room(0);
  step.put({0, 0, -3}, {10, 30, -2}, kHit).put({0, 0, -2}, {10, 30, 2}, kMiss);
  EXPECT_NEAR(step.floor_below_m(1.25).value(), -0.25, 1e-9);
}

TEST(FloorBelow, NeedsTwelveLines) {
  Blocks little;
  little.put({0, 0, 0}, {19, 2, 1}, kHit);
  EXPECT_TRUE(little.floor_below_m(1.0));
  Blocks less;
  less.put({0, 0, 0}, {17, 2, 1}, kHit);
  EXPECT_FALSE(less.floor_below_m(1.0));
}

}  // namespace
}  // namespace hypermap
