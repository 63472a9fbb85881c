// SPDX-License-Identifier: BSD-3-Clause
#include "footprints/column_evidence.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace hypermap {
namespace {

constexpr double kEdgeM = 0.5;
constexpr ObjectId kOwn{7};
constexpr ObjectId kOther{8};

/// Its box spans columns of 0.5 m at x 0 to 2, y 0 to 0.5, five leaves high, above a floor.
Object object_with_box() {
  Object object;
  object.id = kOwn;
  object.box = {{0.1, 0.1, 0.0}, {1.9, 0.4, 2.5}};
  return object;
}

LeafSample leaf(int col, int level, bool occupied, ObjectId owner = kNoObject) {
  LeafSample sample;
  sample.centre_in_map = kEdgeM * Eigen::Vector3d(col + 0.5, 0.5, level + 0.5);
  sample.edge_m = kEdgeM;
  sample.occupied = occupied;
  sample.object = owner;
  return sample;
}

/// The others, free leaves between, and the floor below.
std::vector<LeafSample> column(int col, const std::vector<LeafSample>& others) {
  std::vector<LeafSample> leaves = others;
  leaves.push_back(leaf(col, -1, true));
  for (int level = 0; level < 5; ++level) {
    bool is_there = false;
    for (const LeafSample& other : others)
      is_there = is_there || other.centre_in_map.z() == kEdgeM * (level + 0.5);
    if (!is_there) leaves.push_back(leaf(col, level, false));
  }
  return leaves;
}

LeafSource source(std::vector<LeafSample> leaves) {
  return [leaves = std::move(leaves)](const LeafVisitor& visit) {
    for (const LeafSample& sample : leaves) visit(sample);
  };
}

bool can_hold_more(const Object& object, const std::vector<LeafSample>& leaves, double x) {
  const std::vector<const Object*> objects{&object};
  return columns_of(objects, source(leaves), kEdgeM).front().can_hold_more({x, 0.25});
}

TEST(ColumnEvidence, WhatWasLookedThroughHoldsNoMore) {
  const Object object = object_with_box();
  const auto leaves = column(1, {});
  EXPECT_FALSE(can_hold_more(object, leaves, 0.75));
  EXPECT_TRUE(can_hold_more(object, leaves, 0.25)) << "nobody looked there";
  EXPECT_TRUE(can_hold_more(object, leaves, 5.0)) << "no column";
}

TEST(ColumnEvidence, AFifthOfItsHeightUnseenCanHideSomething) {
  const Object object = object_with_box();
  auto leaves = column(1, {});
  leaves.erase(leaves.begin() + 2);  // One of five, after the floor.
  EXPECT_TRUE(can_hold_more(object, leaves, 0.75));
}

TEST(ColumnEvidence, WhereNothingWasSeenUnderItTheObjectMayBe) {
  const Object object = object_with_box();
  auto leaves = column(1, {});
  const auto floor = leaves.begin();
  leaves.erase(floor);
  EXPECT_TRUE(can_hold_more(object, leaves, 0.75));
  leaves.push_back(leaf(1, -1, false));
  EXPECT_FALSE(can_hold_more(object, leaves, 0.75)) << "seen free below it";
  leaves.back() = leaf(1, -2, true);
  EXPECT_TRUE(can_hold_more(object, leaves, 0.75)) << "too far below";
  leaves.push_back(leaf(1, 0, true, kOwn));
  EXPECT_FALSE(can_hold_more(object, leaves, 0.75)) << "something is at its foot";
}

TEST(ColumnEvidence, WhatNobodyOwnsMayBeOfTheObjectButNotAtItsFoot) {
  const Object object = object_with_box();
  EXPECT_TRUE(can_hold_more(object, column(1, {leaf(1, 2, true)}), 0.75));
  EXPECT_FALSE(can_hold_more(object, column(1, {leaf(1, 0, true)}), 0.75)) << "the support";
  EXPECT_FALSE(can_hold_more(object, column(1, {leaf(1, 2, true, kOther)}), 0.75));
}

TEST(ColumnEvidence, OwnLeavesCountWhereTheObjectHasNoPoints) {
  Object object = object_with_box();
  const auto leaves = column(1, {leaf(1, 2, true, kOwn)});
  EXPECT_TRUE(can_hold_more(object, leaves, 0.75));
  object.points.observe(std::vector<Eigen::Vector3f>{{0.6F, 0.25F, 1.2F}});
  EXPECT_FALSE(can_hold_more(object, leaves, 0.75));
}

/// `num_levels` high: a level is a smaller share of it than what is hidden anyway.
bool holds_more_when_high(int num_levels, const std::vector<LeafSample>& leaves) {
  Object object = object_with_box();
  object.box.max_in_map.z() = kEdgeM * num_levels;
  return can_hold_more(object, leaves, 0.75);
}

/// The floor, and free leaves up to that level but for those from `first` to before `end`.
std::vector<LeafSample> free_but(int first, int end, int num_levels) {
  std::vector<LeafSample> leaves{leaf(1, -1, true)};
  for (int level = 0; level < num_levels; ++level) {
    if (level < first || level >= end) leaves.push_back(leaf(1, level, false));
  }
  return leaves;
}

TEST(ColumnEvidence, ALevelThatNobodySawBetweenFreeOnesHidesSomething) {
  EXPECT_FALSE(holds_more_when_high(20, free_but(0, 0, 20)));
  EXPECT_TRUE(holds_more_when_high(20, free_but(9, 10, 20))) << "a seat, seen along it";
  EXPECT_TRUE(holds_more_when_high(20, free_but(19, 20, 20))) << "a top, seen from below";
  EXPECT_FALSE(holds_more_when_high(20, free_but(0, 1, 20))) << "its foot";
}

TEST(ColumnEvidence, ALevelBesideWhatWasMeasuredHidesNothing) {
  for (const int level : {8, 10}) {
    auto leaves = free_but(8, 11, 20);
    for (const int other : {8, 10}) leaves.push_back(leaf(1, other, other == level, kOther));
    EXPECT_FALSE(holds_more_when_high(20, leaves)) << level;
  }
}

TEST(ColumnEvidence, LevelsOfHighObjectsAreSomeLeavesHigh) {
  EXPECT_TRUE(holds_more_when_high(63, free_but(9, 10, 63)));
  EXPECT_FALSE(holds_more_when_high(64, free_but(8, 9, 64))) << "half of a level";
  EXPECT_TRUE(holds_more_when_high(64, free_but(8, 10, 64))) << "a whole one";
  EXPECT_TRUE(holds_more_when_high(1000, free_but(800, 816, 1000)));
  Object unaligned = object_with_box();  // reaches into 64 levels
  unaligned.box.min_in_map.z() = 0.49;
  unaligned.box.max_in_map.z() = 31.99;
  EXPECT_TRUE(can_hold_more(unaligned, free_but(63, 64, 64), 0.75));
  EXPECT_FALSE(can_hold_more(unaligned, free_but(0, 0, 64), 0.75));
}

TEST(ColumnEvidence, ASliverOfALevelHidesNothing) {
  Object object = object_with_box();
  object.box.max_in_map.z() = 10.24;  // twenty levels and a bit
  EXPECT_FALSE(can_hold_more(object, free_but(0, 0, 20), 0.75));
  object.box.max_in_map.z() = 10.26;
  EXPECT_TRUE(can_hold_more(object, free_but(0, 0, 20), 0.75));
}

TEST(ColumnEvidence, LargeLeavesCoverAllTheirColumns) {
  const Object object = object_with_box();
  LeafSample large;
  large.edge_m = 128 * kEdgeM;
  large.centre_in_map = Eigen::Vector3d::Constant(large.edge_m / 2);
  LeafSample below = large;
  below.centre_in_map.z() = -large.edge_m / 2;
  const auto leaves = std::vector<LeafSample>{large, below, leaf(9, 9, false)};
  for (const double x : {0.25, 0.75, 1.25, 1.75}) EXPECT_FALSE(can_hold_more(object, leaves, x));
}

TEST(ColumnEvidence, BoxesThatAreNoneHaveNoColumns) {
  Object object = object_with_box();
  object.box.max_in_map.x() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(can_hold_more(object, column(1, {}), 0.75));
  object.box.max_in_map.x() = 1e9;
  EXPECT_TRUE(can_hold_more(object, column(1, {}), 0.75));
  object = object_with_box();
  for (const double high :
       {1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    object.box.max_in_map.z() = high;
    EXPECT_TRUE(can_hold_more(object, column(1, {}), 0.75)) << high;
  }
  EXPECT_TRUE(can_hold_more(object_with_box(), {}, 0.75)) << "no leaves";
}

TEST(ColumnEvidence, AllObjectsTogetherHaveABoundedNumberOfColumns) {
  Object wide = object_with_box();  // 4,000 x 4,000 columns: 16 of the 20 million.
  wide.box.max_in_map.head<2>() = Eigen::Vector2d(2000.0, 2000.0);
  const Object small = object_with_box();
  const std::vector<const Object*> objects{&wide, &wide, &small};
  const auto columns = columns_of(objects, source(column(1, {})), kEdgeM);
  EXPECT_EQ(columns[0].size(), 16'000'000U);
  EXPECT_TRUE(columns[1].empty());
  EXPECT_EQ(columns[2].size(), 4U);
  EXPECT_TRUE(columns[1].can_hold_more({0.75, 0.25}));
  EXPECT_FALSE(columns[2].can_hold_more({0.75, 0.25}));
}

}  // namespace
}  // namespace hypermap
