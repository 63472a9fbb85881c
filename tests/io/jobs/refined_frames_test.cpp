// SPDX-License-Identifier: BSD-3-Clause
#include "refined_frames.hpp"

#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kNumPassed = 8;
constexpr std::size_t kUnreadable = 3;  ///< No frame is there.
constexpr std::size_t kRefused = 5;     ///< Its depth has another size than its camera.

/// A corner of a room, seen in passing. Every second given pose errs by 1 cm along x.
std::vector<RgbdFrame> frames_in_passing() {
  test::BoxScene scene(test::quarter_kinect_camera());
  scene.add(1, {-2, -3, -0.1}, {4, 3, 0}).add(2, {4, -3, 0}, {4.1, 3, 2.5});
  scene.add(3, {-2, 3, 0}, {4, 3.1, 2.5}).add(4, {3.4, 1.5, 0}, {4, 3, 1.2});
  std::vector<RgbdFrame> frames;
  for (std::size_t i = 0; i < kNumPassed; ++i) {
    const double x_m = 0.05 * static_cast<double>(i);
    RgbdFrame frame = scene.view(test::camera_at({x_m, 0, 1.4}, 0.3, -0.35)).frame;
    Eigen::Isometry3d given = frame.map_from_camera.isometry();
    given.translation().x() += i % 2 == 0 ? 0.0 : 0.01;
    frame.map_from_camera = MapFromCamera(given);
    frame.index = i;
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// What the stream of these frames gives for each, with what is asked of refinement. `num_read`
/// frames were prepared before the first came out.
struct Posed {
  std::vector<Result<PosedFrame>> frames;
  std::size_t num_read = 0;
};

Posed posed(const std::vector<RgbdFrame>& given, const PoseRefinementOptions& refinement) {
  Posed out;
  std::size_t num_prepared = 0;
  const auto prepare = [&](std::size_t position) -> Result<PreparedFrame> {
    ++num_prepared;
    if (position == kUnreadable) return fail(ErrorCode::kIo, "frame 3");
    PreparedFrame prepared;
    prepared.frame = given[position];
    return prepared;
  };
  FrameStream stream(prepare, 0, given.size(), false);
  SemanticMapperOptions options;
  options.refinement = refinement;
  RefinedFrames frames(stream, given.size(), options, [](const RgbdFrame&) { return MaskImage(); });
  for (std::size_t i = 0; i < given.size(); ++i) {
    out.frames.push_back(frames.next());
    if (i == 0) out.num_read = num_prepared;
  }
  return out;
}

TEST(RefinedFrames, WithoutRefinementNothingWaitsAndPosesAreAsGiven) {
  const auto given = frames_in_passing();
  const Posed out = posed(given, {});
  EXPECT_EQ(out.num_read, 1U);
  for (std::size_t i = 0; i < kNumPassed; ++i) {
    ASSERT_EQ(out.frames[i].has_value(), i != kUnreadable);
    if (i == kUnreadable) continue;
    EXPECT_EQ(out.frames[i]->correction.outcome, PoseOutcome::kGiven);
    EXPECT_EQ(out.frames[i]->refine_s, 0.0) << "a stage that there was none of has no times";
    EXPECT_EQ(out.frames[i]->map_from_camera.isometry().matrix(),
              given[i].map_from_camera.isometry().matrix());
  }
}

TEST(RefinedFrames, FramesComeInOrderAfterThoseTheyWaitFor) {
  auto given = frames_in_passing();
  given[kRefused].depth_m = DepthImage(2, 2, 1.0F);
  const Posed out = posed(given, {.rule = PoseRefinementRule::kPointToPlane, .lag_frames = 2});
  EXPECT_EQ(out.num_read, 3U);
  for (std::size_t i = 0; i < kNumPassed; ++i) {
    ASSERT_EQ(out.frames[i].has_value(), i != kUnreadable) << i;
    if (i == kUnreadable) {
      EXPECT_EQ(out.frames[i].error().what, "frame 3");
      continue;
    }
    const RgbdFrame& frame = out.frames[i]->prepared.frame;
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.map_from_camera.isometry().matrix(),
              given[i].map_from_camera.isometry().matrix())
        << "the frame says its given pose";
    EXPECT_EQ(out.frames[i]->correction.outcome,
              i == kRefused ? PoseOutcome::kGiven : PoseOutcome::kRefined)
        << i;
  }
  EXPECT_EQ(out.frames[kRefused]->map_from_camera.isometry().matrix(),
            given[kRefused].map_from_camera.isometry().matrix());
}

/// Largest distance along x of two frames after each other from the 5 cm that they are apart.
double largest_step_error_m(const std::vector<Result<PosedFrame>>& frames) {
  double largest_m = 0.0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (!frames[i] || !frames[i - 1]) continue;
    const double step_m = frames[i]->map_from_camera.origin().xyz.x() -
                          frames[i - 1]->map_from_camera.origin().xyz.x();
    largest_m = std::max(largest_m, std::abs(step_m - 0.05));
  }
  return largest_m;
}

TEST(RefinedFrames, FramesThatWaitForOthersWaverLess) {
  const auto given = frames_in_passing();
  PoseRefinementOptions options{.rule = PoseRefinementRule::kPointToPlane, .lag_frames = 0};
  const double at_once_m = largest_step_error_m(posed(given, options).frames);
  options.lag_frames = 4;
  const double later_m = largest_step_error_m(posed(given, options).frames);
  EXPECT_LT(at_once_m, 0.01);
  EXPECT_LT(later_m, 0.5 * at_once_m);
}

}  // namespace
}  // namespace hypermap
