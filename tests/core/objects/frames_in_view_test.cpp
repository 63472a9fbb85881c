// SPDX-License-Identifier: BSD-3-Clause
// Frames in which two objects were detected, or in view.
#include "hypermap/core/objects/observation_log.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

namespace hypermap {
namespace {

ObservationLog log_of_frames(std::uint64_t first,
                             std::uint64_t end,
                             ObservationKind kind = ObservationKind::kDetection,
                             float score = 0.5F) {
  ObservationLog log;
  for (std::uint64_t frame = first; frame < end; ++frame) {
    log.add({.frame_index = frame,
             .stamp = Stamp{static_cast<std::int64_t>(frame)},
             .kind = kind,
             .score = score});
  }
  return log;
}

DetectionsInView in_view(const ObservationLog& a, const ObservationLog& b, double share) {
  const auto seen = detections_in_view(a, b, share);
  EXPECT_TRUE(seen.has_value());
  return seen.value_or(DetectionsInView());
}

TEST(ObservationLog, InViewIsWhatWasDetectedOrVisible) {
  const ObservationLog log = log_of_frames(0, 10);
  const auto missed = log_of_frames(6, 20, ObservationKind::kMissedDetection, 0.3F);
  EXPECT_EQ(in_view(log, log_of_frames(6, 20), 0.3), (DetectionsInView{4, 4, 4, 4, true}));
  EXPECT_EQ(in_view(log, missed, 0.25), (DetectionsInView{4, 4, 0, 0, true}));
  EXPECT_EQ(in_view(missed, log, 0.25), (DetectionsInView{4, 0, 4, 0, true}));
  EXPECT_EQ(in_view(missed, log, 0.35), (DetectionsInView{0, 0, 0, 0, true})) << "too little of it";
  EXPECT_EQ(in_view(missed, missed, 0.25), (DetectionsInView{14, 0, 0, 0, true}));
  ObservationLog absent;
  absent.add({.frame_index = 3,
              .stamp = Stamp{3},
              .kind = ObservationKind::kMissedDetection,
              .visibility = Visibility::kAbsent});
  EXPECT_EQ(in_view(log, absent, 0.25), (DetectionsInView{1, 1, 0, 0, true})) << "its place was";
}

TEST(ObservationLog, TwoThingsAreDetectedTogetherAsOftenAsByChance) {
  const DetectionsInView seen{.num_frames = 40, .of_first = 20, .of_second = 10, .of_both = 2};
  EXPECT_EQ(seen.of_any(), 28U);
  EXPECT_DOUBLE_EQ(seen.expected_of_both(), 5.0) << "half of ten";
  EXPECT_DOUBLE_EQ(DetectionsInView().expected_of_both(), 0.0);
}

TEST(ObservationLog, AFrameWithSeveralEntriesIsOne) {
  const ObservationLog log = log_of_frames(0, 10);
  ObservationLog repeated = log_of_frames(0, 10);
  for (int again = 0; again < 5; ++again) repeated.merge(log);
  EXPECT_EQ(in_view(log, repeated, 0.3), (DetectionsInView{10, 10, 10, 10, true}));
  EXPECT_EQ(in_view(repeated, log, 0.3), (DetectionsInView{10, 10, 10, 10, true}));
  EXPECT_EQ(num_common_frames(repeated, log), 10U);
}

TEST(ObservationLog, WhoForgotFramesDoesNotKnowAllThatWasInView) {
  const ObservationLog longer = log_of_frames(0, 65);  // forgot frame 0
  EXPECT_FALSE(in_view(longer, log_of_frames(0, 3), 0.3).is_complete);
  EXPECT_FALSE(in_view(log_of_frames(0, 3), longer, 0.3).is_complete);
  EXPECT_EQ(in_view(longer, log_of_frames(1, 3), 0.3), (DetectionsInView{2, 2, 2, 2, true}))
      << "it holds all since both began";
  EXPECT_EQ(detections_in_view(longer, ObservationLog(), 0.3), std::nullopt);
  ObservationLog of_an_earlier_run;  // whose stamps were later
  of_an_earlier_run.add({.frame_index = 0, .stamp = Stamp{5'000}});
  EXPECT_FALSE(in_view(longer, of_an_earlier_run, 0.3).is_complete);
  ObservationLog restarted = log_of_frames(0, 3);
  restarted.add({.frame_index = 3, .stamp = Stamp{0}});
  EXPECT_EQ(detections_in_view(restarted, log_of_frames(0, 3), 0.3), std::nullopt);
}

}  // namespace
}  // namespace hypermap
