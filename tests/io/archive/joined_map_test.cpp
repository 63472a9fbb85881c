// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/joined_map.hpp"

#include "hypermap/io/archive/cropped_map.hpp"
#include "io/archive/wide_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::wide_map;

std::vector<MapArchive> tiles_of(const MapArchive& map) {
  std::vector<MapArchive> tiles;
  const auto regions = map_tiles(map, 2.5).value();
  tiles.reserve(regions.size());
  for (const CropRegion& region : regions) tiles.push_back(cropped(map, region).value().map);
  return tiles;
}

std::map<VoxelKey, MilliLogOdds> voxels_of(const MapArchive& map) {
  std::map<VoxelKey, MilliLogOdds> voxels;
  map.octree->for_each_stored_leaf(
      [&](const StoredLeaf& leaf) { voxels[leaf.key] = leaf.log_odds; });
  return voxels;
}

TEST(JoinedMap, TilesAreTheWholeAgain) {
  const MapArchive map = wide_map();
  std::vector<MapArchive> tiles = tiles_of(map);
  ASSERT_GT(tiles.size(), 6U);
  const auto again = joined(std::move(tiles));
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(voxels_of(*again), voxels_of(map));
  EXPECT_EQ(again->objects, map.objects);
  EXPECT_EQ(again->views, map.views);
  EXPECT_EQ(again->class_grids, map.class_grids);
  EXPECT_EQ(*again->hypermap.find_as<OccupancyLayer>("occupancy"),
            *map.hypermap.find_as<OccupancyLayer>("occupancy"));
  const auto ids_in = [](const MapArchive& one) {
    std::vector<std::uint64_t> ids;
    for (const auto& shape : one.hypermap.find_as<SemanticLayer>("semantic")->objects()) {
      ids.push_back(shape.id);
    }
    std::ranges::sort(ids);
    return ids;
  };
  EXPECT_EQ(ids_in(*again), ids_in(map));
  EXPECT_GE(again->topological_map->vertices().size(), map.topological_map->vertices().size());
}

TEST(JoinedMap, OnePartIsItself) {
  const MapArchive map = wide_map();
  EXPECT_EQ(joined({map}).value(), map);
}

TEST(JoinedMap, PartsOfTwoMapsAreRefused) {
  const std::vector<MapArchive> tiles = tiles_of(wide_map());
  const auto refusal = [&](const auto& change) {
    std::vector<MapArchive> parts{tiles[0], tiles[1]};
    change(parts[1]);
    const auto result = joined(std::move(parts));
    return result ? "none" : to_string(result.error());
  };
  using testing::HasSubstr;
  EXPECT_EQ(refusal([](MapArchive&) {}), "none");
  EXPECT_THAT(refusal([](MapArchive& part) { (void)part.classes.add("cup"); }),
              HasSubstr("classes: must be those"));
  EXPECT_THAT(refusal([](MapArchive& part) { part.provenance.emplace_back(); }),
              HasSubstr("provenance: must tell of the runs"));
  EXPECT_THAT(refusal([](MapArchive& part) { part.octree.reset(); }),
              HasSubstr("octree: must have the options"));
  EXPECT_NE(refusal([&](MapArchive& part) { part = tiles[0]; }), "none") << "everything twice";
}

}  // namespace
}  // namespace hypermap
