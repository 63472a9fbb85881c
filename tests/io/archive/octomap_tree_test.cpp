// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/octomap_tree.hpp"

#include "hypermap/io/archive/octomap_file.hpp"
#include "octree_semantic/support/octomap_trees.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::SemanticOcTree;
using test::SemanticOcTreeNode;
using test::to_color_octomap;
using test::to_octomap;
using test::to_semantic_octomap;
using testing::HasSubstr;
using testing::IsEmpty;

VoxelLabel label_of(std::uint16_t class_id, std::uint32_t object) {
  VoxelLabel label;
  label.object_votes = 3;
  label.object = ObjectId{object};
  label.classes[0] = {.class_id = class_id, .log_odds = 2000};
  return label;
}

/// A floor of free space, 16 x 16 x 8 voxels, and a labelled post in it.
SemanticOctree room() {
  std::vector<StoredLeaf> leaves;
  for (std::uint16_t x = 0; x < 16; ++x)
    for (std::uint16_t y = 0; y < 16; ++y)
      for (std::uint16_t z = 0; z < 8; ++z) {
        StoredLeaf leaf;
        leaf.key = {static_cast<std::uint16_t>(32768 + x),
                    static_cast<std::uint16_t>(32768 + y),
                    static_cast<std::uint16_t>(32768 + z)};
        leaf.log_odds = -2000;
        if (x == 3 && y == 5) {
          leaf.log_odds = static_cast<MilliLogOdds>(847 + z);
          leaf.label = label_of(7, 12);
        }
        leaves.push_back(leaf);
      }
  return SemanticOctree::from_leaves({}, leaves).value();
}

TEST(OctomapTree, AMapSurvivesAsAFileExactly) {
  const SemanticOctree octree = room();
  const OctomapTree tree = to_octomap_tree(octree);
  // 3 of the 4 bricks become one leaf each; the fourth has the post.
  EXPECT_LT(tree.leaves.size(), 512U);
  EXPECT_EQ(tree.labels.size(), 8U);
  const auto file = parse_octomap(write_octomap(tree).value(), {.file = "map.ot"});
  ASSERT_TRUE(file) << to_string(file.error());
  const auto back = to_semantic_octree(file->value);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_THAT(back->findings, IsEmpty());
  EXPECT_TRUE(back->value == octree);
}

TEST(OctomapTree, ALargeLeafBecomesItsVoxels) {
  // Depth 14: 4 x 4 x 4 voxels.
  const OctomapTree tree{.resolution_m = 0.1,
                         .leaves = {{.key = {4, 8, 0}, .depth = 14, .log_odds = 0.847F}}};
  const auto octree = to_semantic_octree(tree);
  ASSERT_TRUE(octree) << to_string(octree.error());
  EXPECT_EQ(octree->value.num_leaves(), (LeafCount{.occupied = 64, .free = 0}));
  EXPECT_EQ(octree->value.resolution_m(), 0.1);
}

TEST(OctomapTree, TooLargeALeafIsRefusedBeforeAnythingIsSplit) {
  const OctomapTree tree{.leaves = {{.depth = 0, .log_odds = 1.0F}}};  // 2^48 voxels
  const auto octree = to_semantic_octree(tree);
  ASSERT_FALSE(octree);
  EXPECT_EQ(octree.error().code, ErrorCode::kLimit);
  EXPECT_THAT(octree.error().what, HasSubstr("281474976710656 voxels"));
}

TEST(OctomapTree, AFewBytesCannotAskForMuchMemory) {
  // Depth 8: 2^24 voxels in one leaf, beyond 2^22 and beyond 512 a leaf.
  const OctomapTree tree{.leaves = {{.depth = 8, .log_odds = 1.0F}}};
  EXPECT_EQ(to_semantic_octree(tree).error().code, ErrorCode::kLimit);
  const OctomapTree small{.leaves = {{.depth = 10, .log_odds = 1.0F}}};  // 2^18
  EXPECT_TRUE(to_semantic_octree(small));
}

TEST(OctomapTree, WhatTheConversionRoundsOrClampsIsCounted) {
  const OctomapTree tree{.leaves = {{.key = {0, 0, 0}, .log_odds = 0.84729786F},
                                    {.key = {1, 0, 0}, .log_odds = 9.0F},
                                    {.key = {0, 1, 0}, .log_odds = -2.0F}}};
  const auto octree = to_semantic_octree(tree);
  ASSERT_TRUE(octree);
  ASSERT_EQ(octree->findings.size(), 2U);
  EXPECT_THAT(octree->findings[0].error.what, HasSubstr("1 leaves: log-odds were clamped"));
  EXPECT_THAT(octree->findings[1].error.what, HasSubstr("1 leaves: log-odds were rounded"));
  EXPECT_EQ(octree->value.stored_at({0, 0, 0})->log_odds, 847);
  EXPECT_EQ(octree->value.stored_at({1, 0, 0})->log_odds, 3511);
}

TEST(OctomapTree, ALeafIsSeenByVisitorsAsOneCube) {
  // Depth 15 at key (32768, 32768, 32770): 2 voxels of 0.5 m along each edge, so from 0 to 1 m in x
  // and y and from 1 to 2 m in z.
  const OctomapTree tree{.resolution_m = 0.5,
                         .leaves = {{.key = {32768, 32768, 32770}, .depth = 15, .log_odds = 0.5F}}};
  std::vector<LeafSample> seen;
  leaf_source(tree)([&](const LeafSample& leaf) { seen.push_back(leaf); });
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].centre_in_map, Eigen::Vector3d(0.5, 0.5, 1.5));
  EXPECT_EQ(seen[0].edge_m, 1.0);
  EXPECT_TRUE(seen[0].occupied);
}

/// A tree of OctoMap as bytes of its nodes.
template <class Tree>
std::string nodes_of(const Tree& tree) {
  std::ostringstream nodes;
  tree.writeData(nodes);
  return nodes.str();
}

/// What follows the header of one of our files.
std::string nodes_of(const std::string& file) {
  return file.substr(file.find("data\n") + 5);
}

TEST(OctomapTree, OurFilesHaveTheNodesThatOctomapWouldWrite) {
  const SemanticOctree octree = room();
  const OctomapTree tree = to_octomap_tree(octree);
  EXPECT_EQ(nodes_of(write_octomap(tree).value()), nodes_of(*to_semantic_octomap(octree)));
  const OctomapTree plain = occupancy_tree(leaf_source(octree), octree.resolution_m());
  EXPECT_EQ(nodes_of(write_octomap(plain).value()), nodes_of(*to_octomap(octree)));
  EXPECT_EQ(occupied_or_free(tree), occupied_or_free(plain));
}

TEST(OctomapTree, TheColourTwinHasTheColoursOfOctomapsTwin) {
  const SemanticOctree octree = room();
  std::vector<Rgb8> colors;
  for (std::uint8_t id = 0; id < 16; ++id) colors.push_back({id, 10, 20});
  const OctomapTree colored = class_color_tree(leaf_source(octree), octree.resolution_m(), colors);
  const auto theirs = to_color_octomap(octree, colors);
  std::size_t i = 0;
  for (auto leaf = theirs->begin_leafs(), end = theirs->end_leafs(); leaf != end; ++leaf, ++i) {
    ASSERT_LT(i, colored.colors.size());
    const auto color = leaf->getColor();
    EXPECT_EQ(colored.colors[i], (Rgb8{.r = color.r, .g = color.g, .b = color.b}));
    EXPECT_EQ(colored.leaves[i].depth, leaf.getDepth());
  }
  EXPECT_EQ(i, colored.leaves.size());
}

TEST(OctomapTree, LargeLeavesOfASourceStayLargeLeaves) {
  const OctomapTree tree{.resolution_m = 0.5,
                         .leaves = {{.key = {32768, 32768, 32770}, .depth = 15, .log_odds = 1.25F},
                                    {.key = {32770, 32768, 32770}, .log_odds = -0.5F}}};
  EXPECT_EQ(occupancy_tree(leaf_source(tree), 0.5), tree);
}

TEST(OctomapTree, OctomapOpensOurTypeByItsRegistry) {
  const SemanticOctree octree = room();
  std::istringstream file(write_octomap(to_octomap_tree(octree)).value());
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(file));
  const auto* tree = dynamic_cast<SemanticOcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  EXPECT_TRUE(*tree == *to_semantic_octomap(octree));
}

TEST(OctomapTree, ANodeIsTwentyFourBytesLittleEndian) {
  SemanticOcTreeNode node;
  node.setLogOdds(1.0F);
  VoxelLabel label;
  label.object = ObjectId{0x01020304};
  label.object_votes = 5;
  label.rest = -2;
  label.classes[0] = {7, 256};
  node.set_label(label);
  std::stringstream stream;
  node.writeData(stream);
  const std::string expected(
      "\x00\x00\x80\x3f"
      "\x04\x03\x02\x01"
      "\x05\x00"
      "\xfe\xff"
      "\x07\x00\x00\x01"
      "\xff\xff\x00\x00"
      "\xff\xff\x00\x00",
      24);
  EXPECT_EQ(stream.str(), expected);
  SemanticOcTreeNode read;
  read.readData(stream);
  EXPECT_TRUE(read == node);
}

TEST(OctomapTree, EightAlikeSiblingsBecomeTheirParentAgainAndAgain) {
  OctomapTree tree;
  for (std::uint64_t code = 0; code < 64; ++code)
    tree.leaves.push_back({.key = VoxelKey::from_morton(code), .log_odds = 1.0F});
  tree.leaves[5].log_odds = 0.0F;
  EXPECT_EQ(occupied_or_free(tree).leaves,
            (std::vector<OctomapLeaf>{{.key = {0, 0, 0}, .depth = 14, .log_odds = 1.0F}}));
  tree.leaves[63].log_odds = -0.001F;
  EXPECT_EQ(occupied_or_free(tree).leaves.size(), 7U + 8U);
}

TEST(OctomapTree, InvalidTreesAreRefusedByTheWriter) {
  const auto refusal = [](const OctomapTree& tree) {
    const auto bytes = write_octomap(tree);
    return bytes ? "none" : to_string(bytes.error());
  };
  EXPECT_THAT(refusal({.leaves = {{.key = {1, 0, 0}, .depth = 15}}}), HasSubstr("aligned"));
  EXPECT_THAT(refusal({.leaves = {{.key = {1, 0, 0}}, {.key = {0, 0, 0}}}}), HasSubstr("overlaps"));
  EXPECT_THAT(refusal({.leaves = {{.key = {0, 0, 0}, .depth = 15}, {.key = {1, 0, 0}}}}),
              HasSubstr("overlaps"));
  EXPECT_THAT(refusal({.leaves = {{.log_odds = 40.0F}}}), HasSubstr("32.767"));
  EXPECT_THAT(refusal({.kind = OctomapKind::kColor, .leaves = {{}}}), HasSubstr("colo"));
  EXPECT_THAT(refusal({.kind = OctomapKind::kSemantic, .leaves = {{.label = 3}}}),
              HasSubstr("label"));
}

}  // namespace
}  // namespace hypermap
