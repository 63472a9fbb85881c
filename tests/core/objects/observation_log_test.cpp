// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/observation_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace hypermap
