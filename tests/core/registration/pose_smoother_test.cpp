// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/pose_smoother.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// A frame counts half of the one beside it.
constexpr PoseRefinementOptions kHalving{.rule = PoseRefinementRule::kPointToPlane,
                                         .window_frames = 2};

Eigen::Isometry3d at(const Eigen::Vector3d& place_m, double turn_rad = 0.0) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
  pose.translation() = place_m;
  return pose;
}

/// A frame that stands at the origin of the surfaces `model`, given at `x_m` in the map.
void add_at(PoseSmoother& smoother, double x_m, std::uint32_t model = 0) {
  smoother.add(MapFromCamera(at({x_m, 0, 0})),
               {.outcome = PoseOutcome::kRefined},
               RegisteredPose{.model_from_camera = at({0, 0, 0}), .model = model});
}

double next_x_m(PoseSmoother& smoother) {
  return smoother.take().map_from_camera.origin().xyz.x();
}

TEST(PoseSmoother, FramesOnBothSidesCountByHowFarTheyAreApart) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 0.00);
  add_at(smoother, 0.03);
  add_at(smoother, 0.06);
  // Weights 1, 1/2, 1/4: (0 + 0.015 + 0.015) / 1.75.
  EXPECT_NEAR(next_x_m(smoother), 0.03 / 1.75, 1e-9);
  // 1/2, 1, 1/2, of which those before count although they were taken.
  EXPECT_NEAR(next_x_m(smoother), 0.03, 1e-9);
  EXPECT_NEAR(next_x_m(smoother), (0.015 + 0.06) / 1.75, 1e-9);
  EXPECT_EQ(smoother.num_waiting(), 0U);
}

TEST(PoseSmoother, FramesThatWereNotAddedYetHaveNoSay) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 0.01);
  EXPECT_NEAR(next_x_m(smoother), 0.01, 1e-12);
  add_at(smoother, 0.04);
  EXPECT_NEAR(next_x_m(smoother), (0.005 + 0.04) / 1.5, 1e-9);
}

TEST(PoseSmoother, OtherSurfacesHaveNoSay) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 0.00, 0);
  add_at(smoother, 5.00, 1);
  EXPECT_NEAR(next_x_m(smoother), 0.00, 1e-12);
  EXPECT_NEAR(next_x_m(smoother), 5.00, 1e-12);
}

TEST(PoseSmoother, AFrameThatWasNotRegisteredKeepsItsPoseAndMovesNoOther) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 0.02);
  smoother.add(MapFromCamera(at({1, 2, 3}, 0.4)), {.outcome = PoseOutcome::kAmbiguous}, {});
  EXPECT_NEAR(next_x_m(smoother), 0.02, 1e-12);
  const SmoothedPose kept = smoother.take();
  EXPECT_EQ(kept.map_from_camera.isometry().matrix(), at({1, 2, 3}, 0.4).matrix());
  EXPECT_EQ(kept.correction.outcome, PoseOutcome::kAmbiguous);
}

TEST(PoseSmoother, SaysHowFarTheFrameWasMoved) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 0.00);
  add_at(smoother, 0.03);
  const SmoothedPose first = smoother.take();  // (0 + 0.015) / 1.5
  EXPECT_EQ(first.correction.outcome, PoseOutcome::kRefined);
  EXPECT_NEAR(first.correction.translation_m, 0.01, 1e-9);
  EXPECT_NEAR(first.correction.rotation_rad, 0.0, 1e-9);
}

TEST(PoseSmoother, TheFirstFrameOfItsSurfacesKeepsItsPoseUntilOthersSayMore) {
  const PoseCorrection first{.outcome = PoseOutcome::kTooFewPoints};
  const RegisteredPose at_origin{};
  PoseSmoother smoother(kHalving);
  smoother.add(MapFromCamera(at({0.02, 0, 0})), first, at_origin);
  EXPECT_EQ(smoother.take().correction.outcome, PoseOutcome::kTooFewPoints) << "alone";
  PoseSmoother waiting(kHalving);
  waiting.add(MapFromCamera(at({0.02, 0, 0})), first, at_origin);
  add_at(waiting, 0.05);
  const SmoothedPose smoothed = waiting.take();
  EXPECT_EQ(smoothed.correction.outcome, PoseOutcome::kRefined);
  EXPECT_NEAR(smoothed.map_from_camera.origin().xyz.x(), (0.02 + 0.025) / 1.5, 1e-9);
}

TEST(PoseSmoother, ACorrectionBeyondTheLimitsIsRefused) {
  PoseRefinementOptions options = kHalving;
  options.max_translation_m = 0.009;
  PoseSmoother smoother(options);
  add_at(smoother, 0.00);
  add_at(smoother, 0.03);  // 1 cm for either
  const SmoothedPose kept = smoother.take();
  EXPECT_EQ(kept.correction.outcome, PoseOutcome::kTooLarge);
  EXPECT_EQ(kept.map_from_camera.origin().xyz.x(), 0.0);
}

TEST(PoseSmoother, FramesLongTakenAreForgotten) {
  PoseSmoother smoother(kHalving);
  add_at(smoother, 100.0);
  for (int i = 0; i < 20; ++i) {
    (void)smoother.take();
    add_at(smoother, 0.0);
  }
  // Eight before it are kept; 2^-9 of 100 m would be 20 cm.
  EXPECT_EQ(next_x_m(smoother), 0.0);
}

TEST(PoseSmoother, SurfacesThatLieElsewhereAreBroughtIntoTheMap) {
  // All given poses are right; the surfaces are turned and moved against the map.
  const Eigen::Isometry3d map_from_model = at({0.3, -0.2, 0.1}, 0.7);
  PoseSmoother smoother({.rule = PoseRefinementRule::kPointToPlane});
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < 20; ++i) {
    truth.push_back(at({0.2 * i, 0.1 * i, 1.0}, 0.1 * i));
    smoother.add(MapFromCamera(truth.back()),
                 {},
                 RegisteredPose{.model_from_camera = map_from_model.inverse() * truth.back()});
  }
  for (const Eigen::Isometry3d& pose : truth) {
    EXPECT_TRUE(smoother.take().map_from_camera.isometry().isApprox(pose, 1e-9));
  }
}

/// Root mean square over frames whose given places err by 1 cm of white noise, of which each waits
/// for `lag_frames`, of how far x is from the truth. Those at either end are left out.
double remaining_error_m(std::size_t lag_frames) {
  constexpr int kNumFrames = 2000;
  constexpr std::size_t kEnd = 100;
  const CounterRng random(7, 1);
  PoseSmoother smoother({.rule = PoseRefinementRule::kPointToPlane, .window_frames = 8});
  std::vector<double> errors_m;
  for (int i = 0; i < kNumFrames; ++i) {
    // Of variance 1 / 12.
    const double noise = random.uniform_at(static_cast<std::uint64_t>(i)) - 0.5;
    add_at(smoother, 0.01 * std::sqrt(12.0) * noise);
    if (smoother.num_waiting() > lag_frames) errors_m.push_back(next_x_m(smoother));
  }
  double sum_m2 = 0.0;
  for (std::size_t i = kEnd; i + kEnd < errors_m.size(); ++i) sum_m2 += errors_m[i] * errors_m[i];
  return std::sqrt(sum_m2 / static_cast<double>(errors_m.size() - 2 * kEnd));
}

TEST(PoseSmoother, BothSidesHalveTheVariance) {
  // With shares q = 7/8 of the frame beside it: (1 - q) / (1 + q) = 1 / 15 of the variance is left
  // by those before alone, and half of that, (1 + q^2)(1 - q) / (1 + q)^3 = 0.0335, by both sides.
  EXPECT_NEAR(remaining_error_m(0), 0.01 * std::sqrt(1.0 / 15.0), 2e-4);
  EXPECT_NEAR(remaining_error_m(60), 0.01 * std::sqrt(0.0335), 2e-4);
}

}  // namespace
}  // namespace hypermap
