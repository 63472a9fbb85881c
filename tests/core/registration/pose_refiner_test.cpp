// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/pose_refiner.hpp"

#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr PoseRefinementOptions kOn{.rule = PoseRefinementRule::kPointToPlane};

/// Floor at z = 0 and walls at x = 4 and y = 3, with a shelf in the corner.
test::BoxScene room() {
  test::BoxScene scene(test::half_kinect_camera());
  scene.add(1, {-2, -3, -0.1}, {4, 3, 0}).add(2, {4, -3, 0}, {4.1, 3, 2.5});
  scene.add(3, {-2, 3, 0}, {4, 3.1, 2.5}).add(4, {3.4, 1.5, 0}, {4, 3, 1.2});
  return scene;
}

/// A floor alone.
test::BoxScene floor_alone() {
  return test::BoxScene(test::half_kinect_camera()).add(1, {-20, -20, -0.1}, {20, 20, 0});
}

/// Floor and two walls that go on along x.
test::BoxScene corridor() {
  test::BoxScene scene(test::half_kinect_camera());
  scene.add(1, {-50, -1, -0.1}, {50, 1, 0});
  scene.add(2, {-50, 1, 0}, {50, 1.1, 3}).add(3, {-50, -1.1, 0}, {50, -1, 3});
  return scene;
}

MapFromCamera moved(const MapFromCamera& pose,
                    const Eigen::Vector3d& by_m,
                    const Eigen::Vector3d& turn_rad) {
  Eigen::Isometry3d isometry = pose.isometry();
  if (turn_rad.norm() > 0.0) {
    isometry.linear() =
        Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()) * isometry.linear();
  }
  isometry.translation() += by_m;
  return MapFromCamera(isometry);
}

RgbdFrame given_at(RgbdFrame frame, const MapFromCamera& pose) {
  frame.map_from_camera = pose;
  return frame;
}

/// Frames that make a scene known.
constexpr int kNumKnownFrames = test::kSanitized ? 3 : 6;

/// A refiner that knows what `scene` looks like from several places, at their true poses.
PoseRefiner refiner_of(const test::BoxScene& scene,
                       double pitch_rad,
                       PoseRefinementOptions options = kOn) {
  PoseRefiner refiner(options);
  for (int i = 0; i < kNumKnownFrames; ++i) {
    const RgbdFrame frame =
        scene.view(test::camera_at({0.1 * i, 0.05 * i, 1.4}, (10.0 + 5.0 * i) * kDegree, pitch_rad))
            .frame;
    RefinedPose known = refiner.refine(frame, {});
    known.model_from_camera = frame.map_from_camera.isometry();
    known.correction.outcome = PoseOutcome::kRefined;
    refiner.add(frame, known);
  }
  return refiner;
}

/// The room, a refiner that knows it, and a pose at which it is seen next.
struct KnownRoom {
  test::BoxScene scene = room();
  PoseRefiner refiner;
  MapFromCamera truth = test::camera_at({0.25, 0.1, 1.4}, 25 * kDegree, -20 * kDegree);

  explicit KnownRoom(const PoseRefinementOptions& options = kOn)
      : refiner(refiner_of(scene, -20 * kDegree, options)) {}
};

/// `kOn`, but larger corrections are refused.
PoseRefinementOptions corrected_by_at_most(double translation_m) {
  PoseRefinementOptions options = kOn;
  options.max_translation_m = translation_m;
  return options;
}

double distance_m(const MapFromCamera& a, const MapFromCamera& b) {
  return (a.origin().xyz - b.origin().xyz).norm();
}

double angle_rad(const MapFromCamera& a, const MapFromCamera& b) {
  return Eigen::AngleAxisd(a.isometry().linear().transpose() * b.isometry().linear()).angle();
}

TEST(PoseRefiner, InARoomASmallErrorIsFoundToAMillimetre) {
  PoseRefinementOptions options = kOn;
  options.sigma_m = 0.05;  // surfaces 4 m away outweigh such a pose a hundredfold
  const auto [scene, refiner, truth] = KnownRoom(options);
  const RgbdFrame frame = scene.view(truth).frame;
  const MapFromCamera given =
      moved(truth, {0.012, -0.009, 0.008}, Eigen::Vector3d(0.4, -0.5, 0.6) * kDegree);
  const RefinedPose refined = refiner.refine(given_at(frame, given), {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kRefined);
  EXPECT_EQ(refined.correction.num_directions, 6);
  EXPECT_LT(distance_m(refined.map_from_camera, truth), 0.001);
  EXPECT_LT(angle_rad(refined.map_from_camera, truth), 0.05 * kDegree);
  EXPECT_NEAR(refined.correction.translation_m, distance_m(given, truth), 0.001);
  EXPECT_NEAR(refined.correction.rotation_rad, angle_rad(given, truth), 0.05 * kDegree);
}

TEST(PoseRefiner, TheSensorsNoiseLeavesMillimetres) {
  const auto [scene, refiner, truth] = KnownRoom();
  const RgbdFrame frame = scene.view(truth, 7).frame;
  const RefinedPose refined = refiner.refine(
      given_at(frame, moved(truth, {0.01, 0.01, -0.01}, Eigen::Vector3d(0, 0, 1) * kDegree)), {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kRefined);
  EXPECT_LT(distance_m(refined.map_from_camera, truth), 0.004);
  EXPECT_LT(angle_rad(refined.map_from_camera, truth), 0.15 * kDegree);
}

TEST(PoseRefiner, OverAFloorAloneWhatItDoesNotDetermineStaysAsGiven) {
  const test::BoxScene scene = floor_alone();
  const PoseRefiner refiner = refiner_of(scene, -50 * kDegree);
  const MapFromCamera truth = test::camera_at({0.2, 0.1, 1.4}, 20 * kDegree, -50 * kDegree);
  const RgbdFrame frame = scene.view(truth).frame;
  const MapFromCamera given =
      moved(truth, {0.01, 0.02, 0.012}, Eigen::Vector3d(0.4, 0.3, 0.5) * kDegree);
  const RefinedPose refined = refiner.refine(given_at(frame, given), {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kRefined);
  EXPECT_EQ(refined.correction.num_directions, 3);
  const Eigen::Vector3d place_m = refined.map_from_camera.origin().xyz;
  EXPECT_NEAR(place_m.z(), truth.origin().xyz.z(), 0.001);
  EXPECT_NEAR(place_m.x(), given.origin().xyz.x(), 1e-4) << "along the floor";
  EXPECT_NEAR(place_m.y(), given.origin().xyz.y(), 1e-4);
  // Up is as it is, the turn about it as given.
  const Eigen::Vector3d up = refined.map_from_camera.isometry().linear() *
                             truth.isometry().linear().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::acos(std::min(1.0, up.z())), 0.0, 0.05 * kDegree);
  EXPECT_NEAR(angle_rad(refined.map_from_camera, truth), 0.5 * kDegree, 0.05 * kDegree);
}

TEST(PoseRefiner, InACorridorTheWayAlongItStaysAsGiven) {
  const test::BoxScene scene = corridor();
  PoseRefinementOptions options = kOn;
  options.max_depth_m = 4.0;
  const PoseRefiner refiner = refiner_of(scene, -20 * kDegree, options);
  const MapFromCamera truth = test::camera_at({0.2, 0.1, 1.4}, 20 * kDegree, -20 * kDegree);
  const MapFromCamera given =
      moved(truth, {0.02, 0.012, 0.012}, Eigen::Vector3d(0.4, 0.3, 0.5) * kDegree);
  const RefinedPose refined = refiner.refine(given_at(scene.view(truth).frame, given), {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kRefined);
  EXPECT_EQ(refined.correction.num_directions, 5);
  EXPECT_NEAR(refined.map_from_camera.origin().xyz.x(), given.origin().xyz.x(), 1e-3);
  EXPECT_NEAR(refined.map_from_camera.origin().xyz.y(), truth.origin().xyz.y(), 1e-3);
  EXPECT_NEAR(refined.map_from_camera.origin().xyz.z(), truth.origin().xyz.z(), 1e-3);
  EXPECT_LT(angle_rad(refined.map_from_camera, truth), 0.05 * kDegree);
}

TEST(PoseRefiner, TheFirstFrameAndPlacesNeverSeenKeepTheirPose) {
  const RgbdFrame frame =
      room().view(test::camera_at({0, 0, 1.4}, 20 * kDegree, -20 * kDegree)).frame;
  PoseRefiner refiner(kOn);
  const RefinedPose first = refiner.refine(frame, {});
  EXPECT_EQ(first.correction.outcome, PoseOutcome::kTooFewPoints);
  EXPECT_EQ(first.map_from_camera.isometry().matrix(), frame.map_from_camera.isometry().matrix());
  const auto registered = refiner.add(frame, first);
  ASSERT_TRUE(registered) << "the surfaces begin with it";
  EXPECT_EQ(registered->model_from_camera.matrix(), frame.map_from_camera.isometry().matrix());
  const MapFromCamera elsewhere = moved(frame.map_from_camera, {30, 0, 0}, {0, 0, 0});
  const RefinedPose far = refiner.refine(given_at(frame, elsewhere), {});
  EXPECT_EQ(far.correction.outcome, PoseOutcome::kTooFewPoints);
  EXPECT_EQ(far.map_from_camera.isometry().matrix(), elsewhere.isometry().matrix());
}

TEST(PoseRefiner, AFrameWithoutDepthKeepsItsPose) {
  PoseRefiner refiner(kOn);
  RgbdFrame blind = room().view(test::camera_at({0, 0, 1.4}, 20 * kDegree, -20 * kDegree)).frame;
  blind.depth_m = DepthImage(blind.camera.width_px, blind.camera.height_px, NAN);
  const RefinedPose refined = refiner.refine(blind, {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kTooFewPoints);
  EXPECT_FALSE(refiner.add(blind, refined)) << "no surfaces begin with it";
  const PoseRefiner knowing = refiner_of(room(), -20 * kDegree);
  EXPECT_EQ(knowing.refine(blind, {}).correction.outcome, PoseOutcome::kTooFewPoints);
}

TEST(PoseRefiner, ALargeCorrectionIsRefused) {
  const auto [scene, refiner, truth] = KnownRoom(corrected_by_at_most(0.01));
  const MapFromCamera given = moved(truth, {0.015, -0.01, 0.01}, {0, 0, 0});
  const RefinedPose refined = refiner.refine(given_at(scene.view(truth).frame, given), {});
  EXPECT_EQ(refined.correction.outcome, PoseOutcome::kTooLarge);
  EXPECT_EQ(refined.map_from_camera.isometry().matrix(), given.isometry().matrix());
  EXPECT_EQ(refined.correction.translation_m, 0.0);
}

TEST(PoseRefiner, PixelsThatAreLeftOutMoveNothing) {
  // A tall box that stood before the wall goes 3 cm towards the camera; its pixels are left out.
  const auto with_person = [](double x_m) {
    return room().add(9, {x_m, -1, 0}, {x_m + 0.5, 1, 2});
  };
  const PoseRefiner refiner = refiner_of(with_person(2.4), -10 * kDegree);
  const MapFromCamera truth = test::camera_at({0.25, 0.1, 1.4}, 15 * kDegree, -10 * kDegree);
  const test::SceneView view = with_person(2.37).view(truth);
  MaskImage person(view.frame.camera.width_px, view.frame.camera.height_px);
  for (int v = 0; v < person.height_px(); ++v) {
    for (int u = 0; u < person.width_px(); ++u) person.at(u, v) = view.truth.at(u, v) == 9 ? 1 : 0;
  }
  const RefinedPose with = refiner.refine(view.frame, {});
  const RefinedPose without = refiner.refine(view.frame, person);
  EXPECT_LT(distance_m(without.map_from_camera, truth), 0.002);
  EXPECT_GT(distance_m(with.map_from_camera, truth),
            2.0 * distance_m(without.map_from_camera, truth));
}

TEST(PoseRefiner, TheFirstFramesErrorDoesNotStay) {
  // Only the first given pose is wrong, by 2 cm: the mean of many decides where the map is.
  const test::BoxScene scene = room();
  PoseRefiner refiner(kOn);
  MapFromCamera last;
  double error_m = 1.0;
  constexpr int kNumFrames = test::kSanitized ? 12 : 30;
  for (int i = 0; i < kNumFrames; ++i) {
    const MapFromCamera truth =
        test::camera_at({0.02 * i, 0.01 * i, 1.4}, (15.0 + 0.5 * i) * kDegree, -20 * kDegree);
    const RgbdFrame frame =
        given_at(scene.view(truth).frame, i == 0 ? moved(truth, {0.02, 0, 0}, {0, 0, 0}) : truth);
    const RefinedPose refined = refiner.refine(frame, {});
    refiner.add(frame, refined);
    error_m = distance_m(refined.map_from_camera, truth);
  }
  EXPECT_LT(error_m, 0.004);
}

TEST(PoseRefiner, WhenAllFramesDisagreeTheSurfacesAreBegunAnew) {
  auto [scene, refiner, truth] = KnownRoom(corrected_by_at_most(0.02));
  const RgbdFrame jumped = given_at(scene.view(truth).frame, moved(truth, {0.05, 0, 0}, {0, 0, 0}));
  for (int i = 0; i < 10; ++i) {
    const RefinedPose refused = refiner.refine(jumped, {});
    EXPECT_NE(refused.correction.outcome, PoseOutcome::kRefined) << i;
    const auto registered = refiner.add(jumped, refused);
    ASSERT_EQ(registered.has_value(), i == 9) << i;
    EXPECT_EQ(registered.value_or(RegisteredPose{}).model, i == 9 ? 1U : 0U);
  }
  const RefinedPose refined = refiner.refine(jumped, {});
  EXPECT_NE(refined.correction.outcome, PoseOutcome::kTooLarge);
  EXPECT_LT(refined.correction.translation_m, 0.001);
}

TEST(PoseRefinementOptions, ValuesOutOfRangeAreRefusedByName) {
  EXPECT_TRUE(validate(kOn));
  EXPECT_EQ(validate(PoseRefinementOptions{.sigma_m = 0.0}).error().field, "sigma_m");
  EXPECT_EQ(validate(PoseRefinementOptions{.max_cells = 2}).error().field, "max_cells");
  EXPECT_EQ(validate(PoseRefinementOptions{.lag_frames = -1}).error().field, "lag_frames");
  EXPECT_EQ(
      validate(PoseRefinementOptions{.max_rotation_rad = std::numeric_limits<double>::quiet_NaN()})
          .error()
          .field,
      "max_rotation_rad");
}

}  // namespace
}  // namespace hypermap
