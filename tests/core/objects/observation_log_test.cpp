// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/observation_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

ObservationLogEntry seen(std::uint64_t frame, ClassId id = ClassId{1}, float bearing_rad = 0.1F) {
  return {.frame_index = frame,
          .stamp = Stamp{static_cast<std::int64_t>(frame)},
          .class_id = id,
          .score = 0.5F,
          .bearing_rad = bearing_rad,
          .distance_m = 2.0F,
          .effect = 1.0F};
}

TEST(ObservationLog, TheFirstAndTheNewestStay) {
  ObservationLog observation_log;
  for (std::uint64_t frame = 0; frame < 100; ++frame) observation_log.add(seen(frame));
  EXPECT_EQ(observation_log.state().first->frame_index, 0U);
  EXPECT_EQ(observation_log.state().newest.size(), 64U);
  EXPECT_EQ(observation_log.state().newest.front().frame_index, 36U);
  EXPECT_EQ(observation_log.state().newest.back().frame_index, 99U);
}

TEST(ObservationLog, TheFirstIsTheNewestAsLongAsItIsAlone) {
  ObservationLog log;
  ObservationLogEntry entry = seen(3);
  entry.belief_change = 1.23456F;
  log.add(entry);
  EXPECT_FLOAT_EQ(log.state().newest[0].belief_change, 1.235F);
  EXPECT_EQ(log.state().first, log.state().newest[0]);
  log.add_to_newest(LogOdds(-0.25), LogOdds(-1.0));
  EXPECT_FLOAT_EQ(log.state().newest[0].effect, 0.75F);
  EXPECT_FLOAT_EQ(log.state().newest[0].belief_change, 0.235F);
  EXPECT_FLOAT_EQ(log.state().summaries[0].effect_sum, 0.75F);
  EXPECT_EQ(log.state().first, log.state().newest[0]);
}

TEST(ObservationLog, ChangesOfOtherClassesStayAndAddUp) {
  ObservationLog log;
  ObservationLogEntry entry = seen(3);
  const std::vector first{BeliefChange{ClassId{4}, -0.4F}, BeliefChange{ClassId{2}, 0.3F}};
  const std::vector more{BeliefChange{ClassId{4}, -0.25F}};
  const std::vector sum{BeliefChange{ClassId{4}, -0.65F}, BeliefChange{ClassId{2}, 0.3F}};
  entry.other_changes = BeliefChanges::from_entries(first).value();
  log.add(entry);
  EXPECT_EQ(log.state().newest[0].other_changes, entry.other_changes);
  log.add_to_newest(LogOdds(-0.25), LogOdds(-1.0), BeliefChanges::from_entries(more).value());
  EXPECT_EQ(log.state().newest[0].other_changes, BeliefChanges::from_entries(sum).value());
  EXPECT_EQ(log.state().first, log.state().newest[0]);
}

TEST(ObservationLog, AnEntryWhoseOtherChangesAreOfItsOwnClassIsRefused) {
  ObservationLog log;
  log.add(seen(3));
  ObservationLogState state = log.state();
  const std::vector own{BeliefChange{ClassId{1}, -0.4F}};
  state.newest[0].other_changes = BeliefChanges::from_entries(own).value();
  const auto result = ObservationLog::from_state(state);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().field, "ledger");
  EXPECT_EQ(result.error().what, "has an entry whose other changes are of its own class");
}

TEST(ObservationLog, SumsAreKeptPerClassAndDirection) {
  ObservationLog observation_log;
  for (int i = 0; i < 3; ++i) observation_log.add(seen(5));
  observation_log.add(seen(6, ClassId{2}));
  observation_log.add(seen(7, ClassId{1}, 3.0F));
  ASSERT_EQ(observation_log.state().summaries.size(), 3U);
  EXPECT_EQ(observation_log.state().summaries[0].count, 3U);
  EXPECT_FLOAT_EQ(observation_log.state().summaries[0].score_sum, 1.5F);
  EXPECT_EQ(observation_log.num_detections(), 5U);
  EXPECT_EQ(observation_log.num_detections(ClassId{1}), 4U);
}

TEST(ObservationLog, ItNeverTakesMoreThanSixteenKilobytes) {
  ObservationLog observation_log;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    observation_log.add(seen(i, ClassId{i % 80}, 0.37F * static_cast<float>(i)));
  }
  const auto& state = observation_log.state();
  const std::size_t bytes = sizeof(ObservationLog) +
                            state.newest.size() * sizeof(ObservationLogEntry) +
                            state.summaries.size() * sizeof(ObservationLogSummary);
  EXPECT_LE(bytes, 16U * 1024U);
  EXPECT_EQ(observation_log.num_detections() + state.num_unsummarised, 10'000U);
}

ObservationLogEntry not_seen(double at_s, Visibility visibility, float visible_share = 0.0F) {
  return {.stamp = Stamp{std::llround(1e9 * at_s)},
          .kind = ObservationKind::kMissedDetection,
          .visibility = visibility,
          .score = visible_share};
}

/// After detections, looks through the object's place, `step_s` apart.
ObservationLog looked_through(int looks, double step_s, std::uint32_t num_detections = 21) {
  ObservationLog log;
  for (std::uint32_t i = 0; i < num_detections; ++i) log.add(seen(i));
  for (int i = 0; i < looks; ++i) log.add(not_seen(step_s * i, Visibility::kAbsent));
  return log;
}

TEST(DetectionRegularity, CountsDetectionsDirectionsAndWhatWasVisibleWithoutOne) {
  ObservationLog log;
  log.add(seen(0));
  log.add(seen(1, ClassId{2}));
  log.add(seen(2, ClassId{1}, 3.0F));
  log.add(not_seen(3, Visibility::kVisible, 0.75F));
  log.add(not_seen(4, Visibility::kPartlyOccluded, 0.5F));
  EXPECT_EQ(detection_regularity(log),
            (DetectionRegularity{.num_detections = 3,
                                 .num_directions = 2,
                                 .num_named_otherwise = 1,
                                 .missed_visibility = 1.25}));
  EXPECT_EQ(detection_regularity({}), DetectionRegularity{});
}

TEST(Gone, AfterFiveClearLooksAndOneSecondWhicheverIsLater) {
  EXPECT_FALSE(is_gone(looked_through(4, 1.0)));
  EXPECT_TRUE(is_gone(looked_through(5, 1.0)));
  EXPECT_FALSE(is_gone(looked_through(5, 0.1))) << "0.4 s";
  EXPECT_FALSE(is_gone(looked_through(10, 0.1))) << "0.9 s";
  EXPECT_TRUE(is_gone(looked_through(11, 0.1))) << "1 s";
}

TEST(Gone, ALookThatShowsItThereBeginsAnew) {
  for (const Visibility shown : {Visibility::kVisible, Visibility::kPartlyOccluded}) {
    ObservationLog log = looked_through(9, 1.0);
    log.add(not_seen(9.0, shown, 0.5F));
    EXPECT_FALSE(is_gone(log));
    for (int i = 0; i < 4; ++i) log.add(not_seen(10.0 + i, Visibility::kAbsent));
    EXPECT_EQ(absence_run(log), (AbsenceRun{4, Stamp{10'000'000'000}, Stamp{13'000'000'000}}));
    EXPECT_FALSE(is_gone(log));
  }
}

TEST(Gone, ADetectionBringsItBack) {
  ObservationLog log = looked_through(9, 1.0);
  log.add(seen(20));
  EXPECT_EQ(absence_run(log), AbsenceRun{});
  EXPECT_FALSE(is_gone(log));
}

TEST(Gone, NoMoreLooksAreAskedForThanAreKept) {
  EXPECT_FALSE(is_gone(looked_through(63, 0.001)));
  EXPECT_TRUE(is_gone(looked_through(64, 0.001)));
}

TEST(Gone, NoLooksMeansNever) {
  EXPECT_FALSE(is_gone(looked_through(60, 1.0), {.looks = 0}));
  EXPECT_TRUE(is_gone(looked_through(2, 0.0), {.looks = 2, .seconds = 0.0}));
}

// Seen n times, it is gone after max(ceil(n / 5), 3) clear looks where that is less than five.
TEST(Gone, WhatWasRarelyDetectedAfterALookForFiveOfThemButThreeAtLeast) {
  for (const auto& [num_detections, looks] :
       {std::pair(1U, 3), {3U, 3}, {4U, 3}, {15U, 3}, {16U, 4}, {20U, 4}}) {
    EXPECT_FALSE(is_gone(looked_through(looks - 1, 1.0, num_detections))) << num_detections;
    EXPECT_TRUE(is_gone(looked_through(looks, 0.01, num_detections))) << num_detections;
    EXPECT_FALSE(is_gone(looked_through(looks, 0.01, num_detections), {.rare_looks = 0}));
  }
  EXPECT_FALSE(is_gone(looked_through(5, 0.1, 21)));
  EXPECT_FALSE(is_gone(looked_through(60, 1.0, 1), {.looks = 0}));
  EXPECT_TRUE(is_gone(looked_through(2, 0.0, 1), {.looks = 2})) << "never more than others";
  EXPECT_EQ(gone_rule_for(0, {}), GoneRule{}) << "who was never detected";
  EXPECT_EQ(gone_rule_for(21, {}), GoneRule{});
  EXPECT_EQ(gone_rule_for(std::numeric_limits<std::uint64_t>::max(), {}), GoneRule{});
  const GoneRule one_for_one{.detections_per_look = 1};
  EXPECT_EQ(gone_rule_for(4, one_for_one).looks, 4U);
  EXPECT_EQ(gone_rule_for(5, one_for_one), one_for_one);
}

TEST(Gone, StampsOfAFileMayBeAnyNumbers) {
  ObservationLog log;
  constexpr auto kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr auto kLargest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t ns : {kLowest, kLowest, kLowest, kLowest, kLargest}) {
    ObservationLogEntry entry = not_seen(0.0, Visibility::kAbsent);
    entry.stamp = Stamp{ns};
    log.add(entry);
  }
  EXPECT_TRUE(is_gone(log));
}

TEST(ObservationLog, MergingKeepsTheOrderOfFrames) {
  ObservationLog a;
  ObservationLog b;
  for (std::uint64_t frame = 1; frame < 80; frame += 2) a.add(seen(frame));
  for (std::uint64_t frame = 0; frame < 80; frame += 2) b.add(seen(frame));
  a.merge(b);
  EXPECT_EQ(a.state().first->frame_index, 0U);
  EXPECT_EQ(a.state().newest.front().frame_index, 16U);
  EXPECT_EQ(a.state().newest.back().frame_index, 79U);
  EXPECT_EQ(a.num_detections(), 80U);
}

TEST(ObservationLog, WhatEitherOfTwoThatAreOneWasDetectedInWasNotMissed) {
  const auto missed = [](std::uint64_t frame) {
    ObservationLogEntry entry = seen(frame);
    entry.kind = ObservationKind::kMissedDetection;
    entry.score = 0.25F;
    entry.effect = -0.5F;
    return entry;
  };
  ObservationLog a;
  a.add(seen(5));
  a.add(missed(8));
  ObservationLog b;
  b.add(missed(5));
  b.add(missed(6));
  b.add(seen(8));
  a.merge(b);
  ASSERT_EQ(a.state().newest.size(), 3U);
  EXPECT_EQ(a.state().newest[0], seen(5));
  EXPECT_EQ(a.state().newest[1], missed(6));
  EXPECT_EQ(a.state().newest[2], seen(8));
  ASSERT_EQ(a.state().summaries.size(), 2U);
  EXPECT_EQ(a.state().summaries[1].count, 1U);
  EXPECT_FLOAT_EQ(a.state().summaries[1].score_sum, 0.25F);
  EXPECT_FLOAT_EQ(a.state().summaries[1].effect_sum, -0.5F);
}

TEST(ObservationLog, FramesOfTwoLogsAreCommonByNumberAndStamp) {
  const auto log_of = [](std::uint64_t first, std::uint64_t end, std::int64_t run_ns) {
    ObservationLog log;
    for (std::uint64_t frame = first; frame < end; ++frame) {
      log.add({.frame_index = frame, .stamp = {run_ns + static_cast<std::int64_t>(frame)}});
    }
    return log;
  };
  const ObservationLog log = log_of(0, 10, 0);
  EXPECT_EQ(num_common_frames(log, log_of(6, 20, 0)), 4U);
  EXPECT_EQ(num_common_frames(log_of(6, 20, 0), log), 4U);
  EXPECT_EQ(num_common_frames(log, log_of(0, 10, 5'000)), 0U) << "frames of another run";
  EXPECT_EQ(num_common_frames(log, ObservationLog()), 0U);
  ObservationLog missed;
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    missed.add({.frame_index = frame,
                .stamp = {static_cast<std::int64_t>(frame)},
                .kind = ObservationKind::kMissedDetection});
  }
  EXPECT_EQ(num_common_frames(log, missed), 0U);
}

TEST(ObservationLog, BearingBinsAreTwentyDegrees) {
  EXPECT_EQ(log_bearing_bin(0.0), 0);
  EXPECT_EQ(log_bearing_bin(0.35), 1);
  EXPECT_EQ(log_bearing_bin(-0.01), 17);
  EXPECT_EQ(log_bearing_bin(-1e-18), 17);
}

TEST(ObservationLog, WhatIsStoredComesBackAndNonsenseIsRefused) {
  ObservationLog observation_log;
  observation_log.add(seen(1));
  observation_log.add(seen(2, ClassId{9}));
  EXPECT_EQ(ObservationLog::from_state(observation_log.state()).value(), observation_log);
  auto no_first = observation_log.state();
  no_first.first.reset();
  EXPECT_FALSE(ObservationLog::from_state(no_first).has_value());
  auto disordered = observation_log.state();
  std::swap(disordered.summaries[0], disordered.summaries[1]);
  EXPECT_FALSE(ObservationLog::from_state(disordered).has_value());
  auto nan = observation_log.state();
  nan.newest[0].score = NAN;
  EXPECT_FALSE(ObservationLog::from_state(nan).has_value());
}

TEST(ObservationLog, ASideIsOneFromWhichADetectionWasRecorded) {
  // Bins of 20 degrees: 350 degrees is bin 17; bins 16 and 0 lie beside it, bins 15 and 1 do not.
  constexpr double kDegree = std::numbers::pi / 180.0;
  ObservationLog log;
  EXPECT_TRUE(was_detected_from(log, 1.0)) << "of no side anything is known";
  log.add({.kind = ObservationKind::kMissedDetection, .bearing_rad = static_cast<float>(M_PI)});
  EXPECT_TRUE(was_detected_from(log, 1.0));
  log.add({.bearing_rad = static_cast<float>(-10.0 * kDegree)});
  for (const double bearing_deg : {-39.0, -10.0, 1.0, 19.0, 350.0, 361.0})
    EXPECT_TRUE(was_detected_from(log, bearing_deg * kDegree)) << bearing_deg;
  for (const double bearing_deg : {-41.0, 21.0, 180.0, -180.0})
    EXPECT_FALSE(was_detected_from(log, bearing_deg * kDegree)) << bearing_deg;
}

}  // namespace
}  // namespace hypermap
