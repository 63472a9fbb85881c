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
  Blocks& put(const Eigen::Vector3i& from, const Eigen::Vector3i& to, MilliLogOdds log_odds) {
    for (int x = from.x(); x < to.x(); ++x) {
      for (int y = from.y(); y < to.y(); ++y) {
        for (int z = from.z(); z < to.z(); ++z) {
          const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + x),
                             static_cast<std::uint16_t>(kOriginKey + y),
                             static_cast<std::uint16_t>(kOriginKey + z)};
          EXPECT_TRUE(octree_.set_leaf({.key = key, .log_odds = log_odds}));
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

}  // namespace
}  // namespace hypermap
