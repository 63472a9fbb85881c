// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

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

TEST(VoxelLabel, SumsOfTwoAreWorkedByHand) {
  VoxelLabel a = labelled({{1, 4000}, {2, 1000}, {3, -500}});
  a.rest = -800;
  VoxelLabel b = labelled({{4, 3000}, {1, 2000}});
  b.rest = -100;
  // 1: 4000 + 2000; 4: -800 + 3000; 2: 1000 - 100; 3: -500 - 100 is dropped, above -900 of the
  // rest.
  VoxelLabel sum = labelled({{1, 6000}, {4, 2200}, {2, 900}});
  sum.rest = -600;
  EXPECT_EQ(sum_of(a, b, kLimit), sum);
  EXPECT_EQ(sum_of(b, a, kLimit), sum);
}

TEST(VoxelLabel, ASumBeyondTheLimitKeepsTheDifferences) {
  const VoxelLabel sum =
      sum_of(labelled({{5, 9000}, {7, 8000}}), labelled({{5, 9000}, {7, 8000}}), kLimit);
  EXPECT_EQ(sum.classes, (labelled({{5, 10000}, {7, 8000}}).classes));
  EXPECT_EQ(sum.rest, -8000);
  EXPECT_TRUE(validate(sum, kLimit));
}

TEST(VoxelLabel, VotesForOneObjectAddUpAndForTwoAreHeldAgainstEachOther) {
  const auto of_object = [](std::uint32_t id, std::uint16_t votes) {
    VoxelLabel label;
    label.object = ObjectId{id};
    label.object_votes = votes;
    return label;
  };
  const auto votes_of = [&](const VoxelLabel& a, const VoxelLabel& b) {
    EXPECT_EQ(sum_of(a, b, kLimit), sum_of(b, a, kLimit));
    const VoxelLabel sum = sum_of(a, b, kLimit);
    return std::pair(sum.object.value, int{sum.object_votes});
  };
  EXPECT_EQ(votes_of(of_object(3, 4), of_object(3, 2)), std::pair(3U, 6));
  EXPECT_EQ(votes_of(of_object(3, 8), of_object(3, 7)), std::pair(3U, 10));
  EXPECT_EQ(votes_of(of_object(3, 4), of_object(2, 1)), std::pair(3U, 3));
  EXPECT_EQ(votes_of(of_object(3, 4), of_object(2, 4)), std::pair(2U, 0));
  EXPECT_EQ(votes_of(of_object(3, 0), VoxelLabel{}), std::pair(3U, 0));
  EXPECT_EQ(votes_of(VoxelLabel{}, VoxelLabel{}), std::pair(0U, 0));
}

}  // namespace
}  // namespace hypermap
