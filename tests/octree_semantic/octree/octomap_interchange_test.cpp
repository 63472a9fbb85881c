// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/octomap_interchange.hpp"

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "octree_semantic/support/octomap_oracle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <sstream>

namespace hypermap::test {
namespace {

SemanticOctree mapped_room() {
  auto tree = SemanticOctree::create({.resolution_m = 0.1}).value();
  FrameIntegrator integrator;
  for (const LabelledFrame& labelled : room_frames(4, 80)) {
    EXPECT_TRUE(integrator.integrate(tree, labelled.frame, labelled.labels, {}));
  }
  return tree;
}

/// `tree` without labels.
SemanticOctree bare(const SemanticOctree& tree) {
  auto made = SemanticOctree::create(tree.options()).value();
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    EXPECT_TRUE(made.set_leaf({.key = leaf.key, .log_odds = leaf.log_odds}));
  });
  return made;
}

TEST(OctomapInterchange, AnOcTreeHasTheSameLeaves) {
  const SemanticOctree tree = mapped_room();
  const Agreement agreement = compare(tree, *to_octomap(tree), 0.0);
  EXPECT_EQ(agreement.both_occupied, tree.num_leaves().occupied);
  EXPECT_EQ(agreement.both_free, tree.num_leaves().free);
  EXPECT_EQ(agreement.only_ours_known + agreement.only_theirs_known, 0U);
  EXPECT_LT(agreement.largest_difference, 1e-6);
}

TEST(OctomapInterchange, OccupancyGoesThereAndBackUnchanged) {
  const SemanticOctree tree = mapped_room();
  EXPECT_EQ(from_octomap(*to_octomap(tree)).value(), bare(tree));
  EXPECT_EQ(from_octomap(*to_color_octomap(tree)).value(), bare(tree));
}

TEST(OctomapInterchange, LabelsGoThereAndBackUnchanged) {
  const SemanticOctree tree = mapped_room();
  EXPECT_EQ(from_octomap(*to_semantic_octomap(tree)).value(), tree);
}

TEST(OctomapInterchange, TheRegisteredTypeIsReadBackByOctomapItself) {
  const SemanticOctree tree = mapped_room();
  std::stringstream file;
  ASSERT_TRUE(to_semantic_octomap(tree)->write(file));
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(file));
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->getTreeType(), "SemanticOcTree");
  const auto* semantic = dynamic_cast<const SemanticOcTree*>(read.get());
  ASSERT_NE(semantic, nullptr);
  EXPECT_EQ(from_octomap(*semantic).value(), tree);
}

TEST(OctomapInterchange, ANodeIsTwentyFourBytesLittleEndian) {
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

TEST(OctomapInterchange, ColorsAreThoseOfTheClasses) {
  auto tree = SemanticOctree::create({.resolution_m = 0.1}).value();
  VoxelLabel chair;
  chair.classes[0] = {4, 1500};
  ASSERT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = 847, .label = chair}));
  ASSERT_TRUE(tree.set_leaf({.key = {32770, 32768, 32768}, .log_odds = 847}));
  ASSERT_TRUE(tree.set_leaf({.key = {32772, 32768, 32768}, .log_odds = -405, .label = chair}));
  const auto colored = to_color_octomap(tree);
  const auto color_at = [&](octomap::key_type x) {
    const auto color = colored->search(octomap::OcTreeKey(x, 32768, 32768))->getColor();
    return Rgb8{color.r, color.g, color.b};
  };
  EXPECT_EQ(color_at(32768), class_color(ClassId{4}));
  EXPECT_EQ(color_at(32770), (Rgb8{160, 160, 160}));
  EXPECT_EQ(color_at(32772), (Rgb8{255, 255, 255}));
}

TEST(OctomapInterchange, PrunedNodesBecomeTheVoxelsTheyStandFor) {
  octomap::OcTree theirs(0.1);
  for (octomap::key_type x = 0; x < 16; ++x) {
    for (octomap::key_type y = 0; y < 16; ++y) {
      for (octomap::key_type z = 0; z < 16; ++z) {
        theirs.setNodeValue(octomap::OcTreeKey(32768 + x, 32768 + y, 32768 + z), 1.2344F, false);
      }
    }
  }
  ASSERT_LT(theirs.getNumLeafNodes(), 10U);
  const SemanticOctree tree = from_octomap(theirs).value();
  EXPECT_EQ(tree.num_leaves(), (LeafCount{4096, 0}));
  EXPECT_EQ(tree.stored_at({32783, 32770, 32768})->log_odds, 1234);
}

TEST(OctomapInterchange, TheSensorModelComesAlong) {
  octomap::OcTree theirs(0.2);
  theirs.setProbHit(0.8);
  theirs.setProbMiss(0.3);
  theirs.setClampingThresMin(0.05);
  theirs.setClampingThresMax(0.99);
  theirs.setOccupancyThres(0.6);
  const SensorModelOptions model = from_octomap(theirs).value().options().sensor_model;
  EXPECT_NEAR(model.hit.value(), 0.8, 1e-6);
  EXPECT_NEAR(model.miss.value(), 0.3, 1e-6);
  EXPECT_NEAR(model.clamp_min.value(), 0.05, 1e-6);
  EXPECT_NEAR(model.clamp_max.value(), 0.99, 1e-6);
  EXPECT_NEAR(model.occupied_from.value(), 0.6, 1e-6);
}

TEST(OctomapInterchange, RefusesWhatCannotBe) {
  octomap::OcTree huge(0.1);
  huge.setNodeValue(octomap::OcTreeKey(1, 2, 3), 1.0F);
  EXPECT_EQ(from_octomap(huge, {.max_voxels = 0}).error().code, ErrorCode::kLimit);

  octomap::OcTree coarse(20.0);
  EXPECT_EQ(from_octomap(coarse).error().field, "resolution_m");

  octomap::OcTree no_number(0.1);
  no_number.setNodeValue(octomap::OcTreeKey(1, 2, 3), 1.0F)
      ->setLogOdds(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(from_octomap(no_number).error().field, "log_odds");

  SemanticOcTree bad_label(0.1);
  VoxelLabel label;
  label.object_votes = 3;
  bad_label.setNodeValue(octomap::OcTreeKey(1, 2, 3), 1.0F)->set_label(label);
  EXPECT_EQ(from_octomap(bad_label).error().field, "object_votes");

  EXPECT_TRUE(from_octomap(octomap::OcTree(0.1))->empty());
}

}  // namespace
}  // namespace hypermap::test
