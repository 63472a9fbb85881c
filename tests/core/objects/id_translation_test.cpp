// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/id_translation.hpp"

#include "core/objects/association_cases.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace hypermap {
namespace {

using testing_support::kChairBox;
using testing_support::kChairClass;
using testing_support::kCupClass;
using testing_support::kNumClasses;
using testing_support::seen;

/// Class c becomes class 20 - c.
IdTranslation reversed_ids() {
  IdTranslation translation{
      .classes = {}, .detectors = {DetectorId{4}, DetectorId{2}}, .frame_offset = 100};
  translation.classes.reserve(kNumClasses);
  for (std::uint32_t c = 0; c < kNumClasses; ++c) translation.classes.push_back(ClassId{20 - c});
  return translation;
}

ObjectMap map_of_a_chair() {
  ObjectMap objects;
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    Observation chair = seen(kChairBox, frame == 1 ? kCupClass : kChairClass, frame);
    chair.detector = DetectorId{static_cast<std::uint32_t>(frame % 2)};
    chair.prior =
        ClassPrior::create({{kChairClass, LogOdds{1.0}}, {kCupClass, LogOdds{-1.0}}}).value();
    associate(objects, std::vector{chair}, {});
  }
  return objects;
}

TEST(IdTranslation, BeliefPriorAndLogTakeTheOtherIds) {
  const ObjectMap before = map_of_a_chair();
  const ObjectMap after = translated(before, reversed_ids()).value();
  const Object& was = before.at(ObjectId{1});
  const Object& is = after.at(ObjectId{1});
  for (std::uint32_t c = 0; c < kNumClasses; ++c) {
    EXPECT_EQ(is.belief.log_odds(ClassId{20 - c}), was.belief.log_odds(ClassId{c})) << c;
    EXPECT_EQ(is.prior.factor(ClassId{20 - c}), was.prior.factor(ClassId{c})) << c;
  }
  const auto& entries = is.observation_log.state().newest;
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].frame_index, 100U);
  EXPECT_EQ(entries[1].detector, DetectorId{2});
  EXPECT_EQ(entries[1].class_id, ClassId{19});
  const auto others = entries[1].other_changes.entries();
  const auto others_before = was.observation_log.state().newest[1].other_changes.entries();
  ASSERT_EQ(others.size(), 4U);
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_EQ(others[i].class_id.value, 20 - others_before[i].class_id.value);
    EXPECT_EQ(others[i].log_odds, others_before[i].log_odds);
  }
  EXPECT_EQ(is.observation_log.num_detections(ClassId{20}),
            was.observation_log.num_detections(kChairClass));
  EXPECT_EQ(is.points, was.points);
  EXPECT_EQ(after.next_id(), before.next_id());
}

TEST(IdTranslation, OfTheSameIdsNothingChanges) {
  IdTranslation same{.classes = {}, .detectors = {DetectorId{0}, DetectorId{1}}, .frame_offset = 0};
  same.classes.reserve(kNumClasses);
  for (std::uint32_t c = 0; c < kNumClasses; ++c) same.classes.push_back(ClassId{c});
  EXPECT_EQ(translated(map_of_a_chair(), same).value(), map_of_a_chair());
}

TEST(IdTranslation, WhatHasNoOtherIdIsRefused) {
  const auto error_of = [](const auto& change) {
    IdTranslation translation = reversed_ids();
    change(translation);
    const auto result = translated(map_of_a_chair(), translation);
    EXPECT_FALSE(result);
    return result ? Error{} : result.error();
  };
  const Error no_class = error_of([](IdTranslation& t) { t.classes.resize(3); });
  EXPECT_EQ(no_class.entry, "object 1");
  EXPECT_EQ(no_class.field, "class");
  EXPECT_EQ(no_class.what, "is 3 of 3");
  EXPECT_EQ(error_of([](IdTranslation& t) { t.detectors.pop_back(); }).field, "detector");
  EXPECT_EQ(error_of([](IdTranslation& t) { t.classes[1] = t.classes[0]; }).code,
            ErrorCode::kInvalidArgument);
  const auto beyond = [](IdTranslation& t) {
    t.frame_offset = std::numeric_limits<std::uint64_t>::max();
  };
  EXPECT_EQ(error_of(beyond).field, "frame_index");
}

}  // namespace
}  // namespace hypermap
