// SPDX-License-Identifier: BSD-3-Clause
#include "merged_archives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A floor of 2 x 2 m, the level `z` of voxels of 10 cm, free above.
MapArchive floor_at(int z) {
  MapArchive archive{.hypermap = {}};
  archive.octree = SemanticOctree::create({.resolution_m = 0.1}).value();
  for (int i = 0; i < 400; ++i) {
    for (int above = 0; above < 2; ++above) {
      const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + i % 20),
                         static_cast<std::uint16_t>(kOriginKey + i / 20),
                         static_cast<std::uint16_t>(kOriginKey + z + above)};
      EXPECT_TRUE(archive.octree->set_leaf(
          {.key = key, .log_odds = static_cast<MilliLogOdds>(above == 0 ? 847 : -405)}));
    }
  }
  return archive;
}

TEST(MergedFloors, ThatLieApartAreSaidToHaveOneBandOfHeights) {
  EXPECT_THAT(merged(floor_at(0), floor_at(2), {}).value().findings, IsEmpty()) << "two voxels";
  const auto apart = merged(floor_at(0), floor_at(5), {}).value();
  ASSERT_THAT(apart.findings, SizeIs(1));
  EXPECT_THAT(to_string(apart.findings.front().error), HasSubstr("0.50 m above"));
  EXPECT_THAT(to_string(merged(floor_at(5), floor_at(0), {}).value().findings.front().error),
              HasSubstr("0.50 m below"));
  EXPECT_EQ(apart.map.floor, MapFloor{});
}

TEST(MergedFloors, WhatALaterMapStatesIsOfBoth) {
  MapArchive stated = floor_at(0);
  stated.floor = {.height_m = 0.1, .source = FloorSource::kStated};
  EXPECT_EQ(merged(floor_at(0), stated, {}).value().map.floor, stated.floor);
}

}  // namespace
}  // namespace hypermap
