// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/absence.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

constexpr ClassId kCup{1};

/// One object, seen `times` from 2.2 m.
ObjectMap map_of_one(int times = 5) {
  ObjectMap map;
  const auto points = surface_of(box_at({0, 0, 0.2}, {0.4, 0.4, 0.4}));
  for (int i = 0; i < times; ++i) {
    const auto frame = static_cast<std::uint64_t>(i);
    (void)associate(map, std::array{observed(points, scores(kCup, 0.8), frame)}, {});
  }
  return map;
}

VisibilityResult result_of(Visibility state, double visible = 1.0) {
  return {.object = ObjectId{1},
          .state = state,
          .visible_fraction = visible,
          .bearing_rad = -M_PI / 2,
          .distance_m = 2.0};
}

double existence_after(const VisibilityResult& v, const AbsenceOptions& options = {}) {
  ObjectMap map = map_of_one();
  (void)apply_absences(map, std::array{v}, options);
  return map.at(ObjectId{1}).existence.value();
}

TEST(Absences, WhatIsVisibleAndNotDetectedLosesAFifth) {
  // [hypermap] 3.4.5: 5 - 0.2.
  EXPECT_DOUBLE_EQ(existence_after(result_of(Visibility::kVisible)), 4.8);
}

TEST(Absences, FromASideOnWhichItWasNeverDetectedAThirdIsLost) {
  // [smap] 3.5.2, figure 3.18: detected from -90 degrees alone, missed from +90: 5 - 0.2 / 3.
  VisibilityResult behind = result_of(Visibility::kVisible);
  behind.bearing_rad = M_PI / 2;
  EXPECT_DOUBLE_EQ(existence_after(behind), 5.0 - 0.2 / 3.0);
  EXPECT_DOUBLE_EQ(existence_after(behind, {.unseen_side_factor = 1.0}), 4.8);
  behind.state = Visibility::kAbsent;
  EXPECT_DOUBLE_EQ(existence_after(behind), 5.0 - 1.0 / 3.0);
}

TEST(Absences, WhatIsHiddenOrOutOfViewLosesNothing) {
  EXPECT_DOUBLE_EQ(existence_after(result_of(Visibility::kOccluded)), 5.0);
  EXPECT_DOUBLE_EQ(existence_after(result_of(Visibility::kOutOfView)), 5.0);
  EXPECT_DOUBLE_EQ(existence_after(result_of(Visibility::kPartlyOccluded, 0.25)), 4.95);
}

TEST(Absences, WhatIsGoneLosesMoreAndItsClassesWithIt) {
  ObjectMap map = map_of_one();
  const Object before = map.at(ObjectId{1});
  const auto report = apply_absences(map, std::array{result_of(Visibility::kAbsent)}, {});
  const Object& after = map.at(ObjectId{1});
  EXPECT_EQ(report.num_absent, 1U);
  EXPECT_DOUBLE_EQ(after.existence.value(), 4.0);
  EXPECT_NEAR((before.belief.log_odds(kCup) - after.belief.log_odds(kCup)).value(), 0.5, 1e-9);
  const std::size_t bin = before.histogram.bin_of(-M_PI / 2);
  // [smap] Eq. (3.12), (3.13) at 2 m: 2 / (1 + 1) = 1, of which the bin gets 0.6.
  EXPECT_NEAR((before.histogram.bins()[bin] - after.histogram.bins()[bin]).value(), 0.6, 1e-9);
  EXPECT_EQ(after.observation_log.state().newest.back().visibility, Visibility::kAbsent);
}

TEST(Absences, WhatThisFrameDetectedIsSparedUnlessTheSourceDoesNot) {
  ObjectMap map = map_of_one();
  const std::array seen{ObjectId{1}};
  (void)apply_absences(map, std::array{result_of(Visibility::kVisible)}, {}, seen);
  EXPECT_DOUBLE_EQ(map.at(ObjectId{1}).existence.value(), 5.0);
  // [hypermap] 3.4.5: it is not checked; net + 0.8.
  (void)apply_absences(
      map, std::array{result_of(Visibility::kVisible)}, {.spare_seen = false}, seen);
  EXPECT_DOUBLE_EQ(map.at(ObjectId{1}).existence.value(), 4.8);
}

TEST(Absences, NobodyExpectsADetectionFromFartherThanEver) {
  VisibilityResult far = result_of(Visibility::kVisible);
  far.distance_m = 4.0;  // it was detected from 2.2 m
  EXPECT_DOUBLE_EQ(existence_after(far), 5.0);
  EXPECT_DOUBLE_EQ(existence_after(far, {.expected_range_factor = 0.0}), 4.8);
}

TEST(Absences, WhatShowsAgainFromFarAwayIsNoLongerLookedThrough) {
  // Nothing decays by such a look, since no detection is expected: it is recorded all the same.
  ObjectMap map = map_of_one();
  const auto run_after = [&map](const VisibilityResult& result) {
    (void)apply_absences(map, std::array{result}, {});
    return absence_run(map.at(ObjectId{1}).observation_log).looks;
  };
  VisibilityResult far = result_of(Visibility::kVisible);
  far.distance_m = 4.0;  // it was detected from 2.2 m
  EXPECT_EQ(run_after(result_of(Visibility::kAbsent)), 1U);
  EXPECT_EQ(run_after(result_of(Visibility::kAbsent)), 2U);
  EXPECT_EQ(run_after(result_of(Visibility::kOccluded)), 2U);
  EXPECT_EQ(run_after(result_of(Visibility::kOutOfView)), 2U);
  EXPECT_EQ(run_after(far), 0U);
  const std::size_t entries = map.at(ObjectId{1}).observation_log.state().newest.size();
  EXPECT_EQ(run_after(far), 0U);
  EXPECT_EQ(map.at(ObjectId{1}).observation_log.state().newest.size(), entries);
}

TEST(Absences, TheLogTellsWhatALookTookFromEachClass) {
  ObjectMap map = map_of_one();
  (void)apply_absences(map, std::array{result_of(Visibility::kAbsent)}, {});
  const ObservationLogEntry entry = map.at(ObjectId{1}).observation_log.state().newest.back();
  EXPECT_FLOAT_EQ(entry.belief_change, -0.5F);
  EXPECT_FALSE(entry.other_changes.contains(kCup));
  ASSERT_FALSE(entry.other_changes.entries().empty());
  for (const BeliefChange& change : entry.other_changes.entries())
    EXPECT_FLOAT_EQ(change.log_odds, -0.5F);
}

TEST(Absences, WhatNobodyBelievesInIsRemoved) {
  ObjectMap map = map_of_one(1);
  std::vector<ObjectId> removed;
  for (int i = 0; i < 4; ++i) {
    removed = apply_absences(map, std::array{result_of(Visibility::kAbsent)}, {}).removed;
    EXPECT_EQ(map.empty(), i == 3);  // 1 - 4 = -3 is the first below -2
  }
  EXPECT_EQ(removed, std::vector{ObjectId{1}});
  EXPECT_EQ(apply_absences(map, std::array{result_of(Visibility::kAbsent)}, {}).num_absent, 0U);
}

TEST(Absences, TheConfidenceRuleRemovesBelowTheThreshold) {
  // [smap] figure 3.23, C.3 with o_valid = 0.5, Eq. (3.27).
  const AbsenceOptions options{.absent_decay = LogOdds{0.0},
                               .removal = RemovalRule::kConfidence,
                               .confidence = {ConfidenceRule::kWeighted}};
  ObjectMap map = map_of_one();
  int frames = 0;
  while (!map.empty() && frames < 100) {
    (void)apply_absences(map, std::array{result_of(Visibility::kAbsent)}, options);
    ++frames;
  }
  // Five observations of ln(0.8/0.2) - ln(0.1/0.9) = 3.58 each: l = 17.9, which falls by 0.5 a
  // frame; tp3 is 0 soon. (4 tp1 + tp2) / 6 < 0.5 needs tp1 of about a half: l = 0 after 36 frames.
  EXPECT_GE(frames, 35);
  EXPECT_LE(frames, 37);
}

/// A wall at z = `depth_m` before a camera at (0, -2, 0.3) that looks along +y.
RgbdFrame wall_at(double depth_m) {
  RgbdFrame frame;
  frame.camera = {160, 120, 130.0, 130.0, 79.5, 59.5};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  pose.translation() = Eigen::Vector3d(0, -2, 0.3);
  frame.map_from_camera = MapFromCamera(pose);
  frame.depth_m = DepthImage(160, 120, static_cast<float>(depth_m));
  return frame;
}

Visibility state_by_panels(double wall_m) {
  const auto depth = BinnedDepthMap::create(wall_at(wall_m));
  const auto results = evaluate_visibility_by_panels(map_of_one(), depth, {});
  return results.empty() ? Visibility::kOutOfView : results.at(0).state;
}

// [smap] Eq. (3.23), [smap] Eq. (3.24), [smap] Eq. (3.25): each corner takes the panel nearest by
// angle, so a wall at 1 m stands before a box that begins at 1.8 m, one at 1.9 m inside and one at
// 3 m after it.
TEST(PanelPolicy, PanelsBeforeInsideAndAfterTellTheState) {
  // [smap] figure 3.24; the object lies 1.8 to 2.2 m before the camera.
  EXPECT_EQ(state_by_panels(1.0), Visibility::kOccluded);
  EXPECT_EQ(state_by_panels(1.9), Visibility::kVisible);
  EXPECT_EQ(state_by_panels(3.0), Visibility::kAbsent);
  EXPECT_EQ(state_by_panels(0.0), Visibility::kOutOfView);
}

/// A wall at `near_m` whose right half stands at `far_m`.
RgbdFrame stepped_wall(double near_m, double far_m) {
  RgbdFrame frame = wall_at(near_m);
  for (int v = 0; v < 120; ++v) {
    for (int u = 80; u < 160; ++u) frame.depth_m.at(u, v) = static_cast<float>(far_m);
  }
  return frame;
}

TEST(HullPolicy, WhatLiesInTheSeenAreaIsVisibleEvenIfHidden) {
  // [hypermap] 3.4.4: the hull of the cloud from above. The object's centre lies 2 m before the
  // camera, between the halves of the wall: hidden by the near one, and yet visible.
  const auto results = evaluate_visibility_by_hull(map_of_one(), stepped_wall(1.0, 4.0), 5.0);
  ASSERT_EQ(results->size(), 1U);
  EXPECT_EQ(results->at(0).state, Visibility::kVisible);
  EXPECT_NEAR(results->at(0).distance_m, std::hypot(2.0, 0.1), 1e-2);
}

TEST(HullPolicy, TheAreaIsThatOfTheCloudWithoutTheCamera) {
  EXPECT_TRUE(evaluate_visibility_by_hull(map_of_one(), stepped_wall(2.5, 4.0), 5.0)->empty())
      << "the object stands between the camera and the cloud";
  EXPECT_TRUE(evaluate_visibility_by_hull(map_of_one(), stepped_wall(0.5, 1.0), 5.0)->empty());
  EXPECT_EQ(evaluate_visibility_by_hull(map_of_one(), wall_at(0.0), 5.0).error().code,
            ErrorCode::kNotFound);
}

TEST(AbsenceOptions, BadValuesAreNamed) {
  EXPECT_TRUE(validate(AbsenceOptions{}).has_value());
  EXPECT_EQ(validate(AbsenceOptions{.missed_decay = LogOdds(-1)}).error().field, "missed_decay");
  EXPECT_EQ(validate(AbsenceOptions{.absent_share = 1.5}).error().field, "absent_share");
  EXPECT_EQ(validate(AbsenceOptions{.occluded_factor = static_cast<double>(NAN)}).error().field,
            "occluded_factor");
}

}  // namespace
}  // namespace hypermap
