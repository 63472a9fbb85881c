// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

constexpr MilliLogOdds kLimit = 10000;

VoxelLabel labelled(std::initializer_list<ClassWeight> weights) {
  VoxelLabel label;
  std::copy(weights.begin(), weights.end(), label.classes.begin());
  return label;
}

TEST(VoxelLabel, TheBestClassNeedsPositiveEvidence) {
  EXPECT_EQ(VoxelLabel{}.best_class(), std::nullopt);
  EXPECT_EQ(labelled({{7, 0}}).best_class(), std::nullopt);
  EXPECT_EQ(labelled({{7, -3}}).best_class(), std::nullopt);
  EXPECT_EQ(labelled({{7, 1}, {2, -500}}).best_class(), ClassId{7});
}

TEST(VoxelLabel, TheMajorityOfFramesDecidesTheObject) {
  VoxelLabel label;
  for (const std::uint32_t id : {1U, 2U, 2U, 2U, 0U, 1U}) label.vote(ObjectId{id});
  // 1: +1; 2: back to 0; 2 takes over: 1, 2; 0 is no vote; 1 against: 1.
  EXPECT_EQ(label.object, ObjectId{2});
  EXPECT_EQ(label.object_votes, 1);
}

TEST(VoxelLabel, AnObjectIsOverturnedAfterElevenContraryFrames) {
  VoxelLabel label;
  for (int i = 0; i < 1000; ++i) label.vote(ObjectId{1});
  EXPECT_EQ(label.object_votes, 10);
  for (int i = 0; i < 10; ++i) label.vote(ObjectId{2});
  EXPECT_EQ(label.object, ObjectId{1});
  label.vote(ObjectId{2});
  EXPECT_EQ(label.object, ObjectId{2});
}

TEST(VoxelLabel, ValidationNamesWhatIsWrong) {
  const auto field_of = [](const VoxelLabel& label) {
    const auto result = validate(label, kLimit);
    return result ? std::string("none") : result.error().field;
  };
  EXPECT_EQ(field_of(VoxelLabel{}), "none");
  EXPECT_EQ(field_of(labelled({{3, 900}, {1, 500}, {2, 500}})), "none");
  EXPECT_EQ(field_of(labelled({{3, 500}, {1, 900}})), "classes") << "not the best first";
  EXPECT_EQ(field_of(labelled({{3, 500}, {1, 500}})), "classes") << "equals by id";
  EXPECT_EQ(field_of(labelled({{3, 500}, {3, 400}})), "classes") << "twice";
  EXPECT_EQ(field_of(labelled({{ClassWeight::kNone, 0}, {3, 400}})), "classes") << "a gap";
  EXPECT_EQ(field_of(labelled({{3, 10001}})), "classes") << "beyond the limit";
  VoxelLabel label;
  label.rest = -10001;
  EXPECT_EQ(field_of(label), "rest");
  label = {};
  label.object_votes = 1;
  EXPECT_EQ(field_of(label), "object_votes") << "votes for nobody";
  label.object = ObjectId{4};
  label.object_votes = 11;
  EXPECT_EQ(field_of(label), "object_votes");
}

}  // namespace
}  // namespace hypermap
