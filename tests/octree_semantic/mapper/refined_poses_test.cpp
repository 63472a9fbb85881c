// SPDX-License-Identifier: BSD-3-Clause
// Refinement of given poses in the whole mapper.
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

const std::vector<RgbdFrame>& true_frames() {
  static const std::vector<RgbdFrame> kFrames =
      test::detected_room_frames(test::kSanitized ? 8 : 24, test::kSanitized ? 160 : 320);
  return kFrames;
}

/// The frames with 1 cm and 0.5 degrees of white noise on their poses.
std::vector<RgbdFrame> with_noisy_poses(std::vector<RgbdFrame> frames) {
  for (RgbdFrame& frame : frames) {
    CounterRng random(5, frame.index);
    Eigen::Isometry3d pose = frame.map_from_camera.isometry();
    for (int i = 0; i < 3; ++i) {
      pose.translation()[i] += 0.01 * random.normal();
      pose.linear() =
          Eigen::AngleAxisd(0.0087 * random.normal(), Eigen::Vector3d::Unit(i)) * pose.linear();
    }
    frame.map_from_camera = MapFromCamera(pose);
  }
  return frames;
}

std::vector<RgbdFrame> noisy_frames() {
  return with_noisy_poses(true_frames());
}

/// A walk through a small room with a table and a shelf, with the noise of the sensor.
std::vector<RgbdFrame> small_room_frames() {
  test::BoxScene scene(test::half_kinect_camera());
  scene.add(1, {-2, -2, -0.1}, {2, 2, 0}).add(2, {2, -2, 0}, {2.1, 2, 2.5});
  scene.add(3, {-2, 2, 0}, {2, 2.1, 2.5}).add(4, {1.5, 0.8, 0}, {2, 2, 1.2});
  scene.add(5, {0.6, -1.2, 0.7}, {1.6, -0.2, 0.75}).add(6, {-0.6, 1.2, 0}, {0.2, 1.7, 0.8});
  std::vector<RgbdFrame> frames;
  constexpr unsigned kNumFrames = test::kSanitized ? 12 : 40;
  for (unsigned i = 0; i < kNumFrames; ++i) {
    const double share = i / 40.0;
    const double yaw_rad = -0.3 + 1.6 * share;
    frames.push_back(
        scene.view(test::camera_at({-0.8 + 0.4 * share, -0.6, 1.3}, yaw_rad, -0.35), i + 1).frame);
    frames.back().index = i;
  }
  return frames;
}

SemanticMapper refining_mapper(int num_threads = 1) {
  SemanticMapperOptions options;
  options.refinement.rule = PoseRefinementRule::kPointToPlane;
  options.num_threads = num_threads;
  return SemanticMapper::create(options).value();
}

/// How far what lies 2 m before the camera is misplaced.
double misplaced_m(const MapFromCamera& pose, const MapFromCamera& truth) {
  const PointInCamera ahead{{0.0, 0.0, 2.0}};
  return ((pose * ahead).xyz - (truth * ahead).xyz).norm();
}

TEST(RefinedPoses, NoisyPosesAreLessThanHalfAsWrong) {
  SemanticMapper mapper = refining_mapper();
  const std::vector<RgbdFrame> truth = small_room_frames();
  const std::vector<RgbdFrame> frames = with_noisy_poses(truth);
  double given_m = 0.0;
  double refined_m = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameReport report = mapper.integrate(frames[i]).value();
    if (i < 4) continue;  // where the map lies is a mean of few frames
    given_m += misplaced_m(frames[i].map_from_camera, truth[i].map_from_camera);
    refined_m += misplaced_m(report.map_from_camera, truth[i].map_from_camera);
  }
  EXPECT_LT(refined_m, 0.5 * given_m);
}

TEST(RefinedPoses, OffGivenPosesAreUsed) {
  SemanticMapper mapper = SemanticMapper::create({}).value();
  for (const RgbdFrame& frame : noisy_frames()) {
    const FrameReport report = mapper.integrate(frame).value();
    EXPECT_EQ(report.pose.outcome, PoseOutcome::kGiven);
    EXPECT_EQ(report.map_from_camera.isometry().matrix(),
              frame.map_from_camera.isometry().matrix());
  }
}

TEST(RefinedPoses, AnyNumberOfThreadsGivesTheSameMap) {
  SemanticMapper one = refining_mapper();
  SemanticMapper four = refining_mapper(4);
  for (const RgbdFrame& frame : noisy_frames()) {
    ASSERT_TRUE(one.integrate(frame));
    ASSERT_TRUE(four.integrate(frame));
  }
  EXPECT_TRUE(one.octree() == four.octree());
  EXPECT_TRUE(one.objects() == four.objects());
}

TEST(RefinedPoses, WhatIsTransientIsNoSurface) {
  SemanticMapperOptions options;
  options.refinement.rule = PoseRefinementRule::kPointToPlane;
  options.objects.transient_class_names = {"person"};
  ClassRegistry classes;
  const ClassId person = classes.add("person").value();
  SemanticMapper mapper = SemanticMapper::create(options, classes).value();
  std::vector<RgbdFrame> frames = noisy_frames();
  for (std::size_t i = 0; i < 4; ++i) {
    RgbdFrame& frame = frames[i];
    frame.detections = {{.box_px = {0.0,
                                    0.0,
                                    static_cast<double>(frame.camera.width_px),
                                    static_cast<double>(frame.camera.height_px)},
                         .class_scores = {{person, Probability(1.0)}},
                         .score = Probability(0.9),
                         .detector = {},
                         .mask = {}}};
    EXPECT_EQ(mapper.integrate(frame)->pose.outcome, PoseOutcome::kTooFewPoints)
        << "a person fills the image";
  }
}

/// What became of the poses of frames in which a person's mask, which is not their box, shows all
/// but the first columns.
std::vector<PoseOutcome> outcomes_behind_a_person(int num_columns) {
  SemanticMapperOptions options;
  options.refinement.rule = PoseRefinementRule::kPointToPlane;
  options.objects.transient_class_names = {"person"};
  ClassRegistry classes;
  const ClassId person = classes.add("person").value();
  SemanticMapper mapper = SemanticMapper::create(options, classes).value();
  std::vector<RgbdFrame> frames = noisy_frames();
  std::vector<PoseOutcome> outcomes;
  for (std::size_t i = 0; i < 4; ++i) {
    RgbdFrame& frame = frames[i];
    MaskImage mask(frame.camera.width_px, frame.camera.height_px, 1);
    for (int v = 0; v < mask.height_px(); ++v)
      std::fill_n(&mask.at(0, v), num_columns, std::uint8_t{0});
    frame.detections = {{.box_px = {1.0, 1.0, 3.0, 3.0},
                         .class_scores = {{person, Probability(1.0)}},
                         .score = Probability(0.9),
                         .detector = {},
                         .mask = mask}};
    outcomes.push_back(mapper.integrate(frame)->pose.outcome);
  }
  return outcomes;
}

TEST(RefinedPoses, WhatAMaskShowsAndWhereItsEdgeMayBeIsNoSurfaceEither) {
  // The edge may be off by 1.5 pixels of 160.
  const auto camera = noisy_frames()[0].camera;
  const auto reach =
      static_cast<int>(std::ceil(mask_tolerance_px(camera.width_px, camera.height_px)));
  for (const PoseOutcome outcome : outcomes_behind_a_person(reach))
    EXPECT_EQ(outcome, PoseOutcome::kTooFewPoints);
  EXPECT_NE(outcomes_behind_a_person(reach + 60).back(), PoseOutcome::kTooFewPoints);
}

}  // namespace
}  // namespace hypermap
