// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_archive.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cstddef>
#include <sstream>
#include <string>

namespace hypermap {
namespace {

using test::all_findings;
using test::kArchiveSource;
using test::member_of;
using test::sample_archive;
using test::zip_of;
using testing::HasSubstr;

TEST(OctreeTwin, OctomapItselfReadsTheOccupancyOfTheOctree) {
  const MapArchive archive = sample_archive();
  std::istringstream twin(member_of(write_archive(archive).value(), "octree.bt"));
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(twin));
  EXPECT_EQ(tree.getResolution(), archive.octree->resolution_m());
  std::size_t num_voxels = 0;
  archive.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const octomap::OcTreeNode* node =
        tree.search(octomap::OcTreeKey(leaf.key.x, leaf.key.y, leaf.key.z));
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(tree.isNodeOccupied(node), leaf.log_odds >= 0);
    ++num_voxels;
  });
  tree.expand();
  EXPECT_EQ(tree.getNumLeafNodes(), num_voxels);
}

TEST(OctreeTwin, AnOctreesTwinTakesNoOtherFilesName) {
  MapArchive archive = sample_archive();
  archive.opaque_files.push_back({.name = "octree.bt", .bytes = "a road"});
  const std::string bytes = write_archive(archive).value();
  EXPECT_EQ(member_of(bytes, "octree.bt"), "a road");
  EXPECT_TRUE(parse_archive(bytes, kArchiveSource)->value == archive);
}

TEST(OctreeTwin, ATwinOfNoOctreeIsLeftOutAndSaid) {
  const auto loaded = parse_archive(
      zip_of(
          {{"hmap_config.yaml",
            "layers: []\nformat_version: 1\nextensions:\n"
            "  - {format: hypermap-octree-twin, version: 1, name: t, frame_id: map, file: t.bt}\n"},
           {"t.bt", "x"}}),
      kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(all_findings(loaded->findings),
              HasSubstr("t.bt: the octree that it stands for is not there, so it is left out"));
  EXPECT_TRUE(loaded->value == MapArchive{});
}

}  // namespace
}  // namespace hypermap
