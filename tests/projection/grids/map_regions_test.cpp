// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/map_regions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace hypermap {
namespace {

using ::testing::SizeIs;

LeafSample leaf_at(double x, double y = 0.0, double z = 0.0, bool occupied = true) {
  return {.centre_in_map = {x, y, z}, .edge_m = 0.1, .occupied = occupied};
}

LeafSource source_over(const std::vector<LeafSample>& leaves) {
  return [&leaves](const LeafVisitor& visit) {
    for (const LeafSample& leaf : leaves) visit(leaf);
  };
}

TEST(MapRegions, OfNothingAreNone) {
  EXPECT_THAT(MapRegions::find(source_over({})).regions(), SizeIs(0));
}

TEST(MapRegions, AGapOfFiftyMetresDividesAndASmallerOneDoesNot) {
  for (const double z : {0.0, 200.0}) {
    // Leaves of 0.1 m: centres 50.1 m apart leave a gap of 50 m between them.
    const std::vector<LeafSample> apart{leaf_at(0.0, 0.0, z), leaf_at(50.11, 0.0, z)};
    EXPECT_THAT(MapRegions::find(source_over(apart)).regions(), SizeIs(2));
    const std::vector<LeafSample> together{leaf_at(0.0, 0.0, z), leaf_at(50.09, 0.0, z)};
    EXPECT_THAT(MapRegions::find(source_over(together)).regions(), SizeIs(1));
  }
}

TEST(MapRegions, GapsAreMeasuredInSpaceAndNotByAxis) {
  const std::vector<LeafSample> askew{leaf_at(0.0), leaf_at(40.0, 40.0)};  // 56.4 m apart
  EXPECT_THAT(MapRegions::find(source_over(askew)).regions(), SizeIs(2));
  const std::vector<LeafSample> above{leaf_at(0.0), leaf_at(0.0, 0.0, 1000.0)};
  EXPECT_THAT(MapRegions::find(source_over(above)).regions(), SizeIs(2));
}

TEST(MapRegions, HangTogetherByWayOfOthers) {
  std::vector<LeafSample> chain;
  for (int i = 0; i <= 30; ++i) chain.push_back(leaf_at(-600.0 + 40.0 * i, 7.0));
  EXPECT_THAT(MapRegions::find(source_over(chain)).regions(), SizeIs(1));
  chain.erase(chain.begin() + 10);
  const auto broken = MapRegions::find(source_over(chain));
  ASSERT_THAT(broken.regions(), SizeIs(2));
  EXPECT_EQ(broken.regions()[0].num_leaves(), 20U);
  EXPECT_EQ(broken.regions()[1].num_leaves(), 10U);
}

TEST(MapRegions, SayHowManyLeavesLieWhereTheLargestFirst) {
  const std::vector<LeafSample> leaves{
      leaf_at(-500.0), leaf_at(0.05, 0.05, 0.05), leaf_at(1.05, 2.05, 3.05, false), leaf_at(900.0)};
  const auto found = MapRegions::find(source_over(leaves));
  ASSERT_THAT(found.regions(), SizeIs(3));
  const MapRegion& largest = found.regions()[0];
  EXPECT_EQ(largest.leaves, (LeafCount{.occupied = 1, .free = 1}));
  EXPECT_LT(largest.bounds_in_map.min_in_map.norm(), 1e-9);
  EXPECT_TRUE(largest.bounds_in_map.max_in_map.isApprox(Eigen::Vector3d(1.1, 2.1, 3.1), 1e-9));
  EXPECT_LT(found.regions()[1].bounds_in_map.max_in_map.x(), 0.0) << "equals by their place";
  EXPECT_EQ(found.region_at({900.0, 0.0, 0.0}), std::optional<std::size_t>(2));
  EXPECT_EQ(found.region_at({300.0, 0.0, 0.0}), std::nullopt);
}

TEST(MapRegions, OnlyLeavesOfTheLargestRemainInTheirOrder) {
  const std::vector<LeafSample> leaves{leaf_at(0.0), leaf_at(700.0), leaf_at(2.0), leaf_at(1.0)};
  std::vector<double> seen;
  const auto source = source_over(leaves);
  leaves_of_largest(source, MapRegions::find(source))(
      [&](const LeafSample& leaf) { seen.push_back(leaf.centre_in_map.x()); });
  EXPECT_EQ(seen, (std::vector<double>{0.0, 2.0, 1.0}));
}

/// Whatever the cubes do: two leaves nearer than the gap are of one region.
TEST(MapRegions, NeverDivideNeighbours) {
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same heaps each time
  std::uniform_real_distribution<double> place(-400.0, 400.0);
  std::vector<LeafSample> leaves;
  leaves.reserve(300);
  for (int i = 0; i < 300; ++i) leaves.push_back(leaf_at(place(random), place(random)));
  const auto found = MapRegions::find(source_over(leaves));
  ASSERT_GT(found.regions().size(), 1U);
  for (const LeafSample& a : leaves) {
    for (const LeafSample& b : leaves) {
      const double gap_m = (a.centre_in_map - b.centre_in_map).norm();
      if (gap_m >= kMaxRegionGapM) continue;
      EXPECT_EQ(found.region_at(a.centre_in_map), found.region_at(b.centre_in_map));
    }
  }
}

}  // namespace
}  // namespace hypermap
