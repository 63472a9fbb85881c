// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/occlusion/object_visibility.hpp"

#include "hypermap/core/objects/association.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// A camera at the origin of the map that looks along +x; 80 x 60 pixels.
RgbdFrame frame_with_depth(float depth_m) {
  RgbdFrame frame;
  frame.camera = {80, 60, 80.0, 80.0, 39.5, 29.5};
  frame.depth_m = DepthImage(80, 60, depth_m);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = Eigen::Vector3d(0, -1, 0);
  pose.linear().col(1) = Eigen::Vector3d(0, 0, -1);
  pose.linear().col(2) = Eigen::Vector3d(1, 0, 0);
  frame.map_from_camera = MapFromCamera(pose);
  return frame;
}

/// The front face of a cube of 0.4 m whose near side lies 2 m ahead, `aside` metres to the left.
Object cube_ahead(double aside = 0.0) {
  Object object;
  std::vector<Eigen::Vector3f> points;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      const double y = aside + 0.02 * column - 0.19;
      points.push_back(Eigen::Vector3d(2.01, y, 0.02 * row - 0.19).cast<float>());
    }
  }
  object.points.observe(points);
  object.box = {{2.0, aside - 0.2, -0.2}, {2.4, aside + 0.2, 0.2}};
  object.centroid_in_map = {2.2, aside, 0.0};
  return object;
}

/// Across a cube of 0.4 m, so far ahead.
std::vector<Eigen::Vector3f> row_of_points(float ahead_m) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(20);
  for (int i = 0; i < 20; ++i)
    points.emplace_back(ahead_m, 0.02F * static_cast<float>(i) - 0.19F, 0.0F);
  return points;
}

struct World {
  ObjectMap objects;
  OcclusionScene scene = OcclusionScene::create().value();
  int num_questions = 0;  ///< How often the scene was asked.

  OcclusionQuery answer() {
    return [this](std::span<const OcclusionRay> rays) -> Result<std::vector<std::uint8_t>> {
      ++num_questions;
      return scene.occluded(rays);
    };
  }
};

VisibilityResult evaluate(World& world,
                          const RgbdFrame& frame,
                          const Object& object,
                          const std::vector<ObjectId>& seen = {}) {
  world.objects = ObjectMap();
  const ObjectId id = world.objects.add(object);
  const auto results = evaluate_visibility(world.objects, frame, world.answer(), {}, seen).value();
  if (results.empty()) return {.object = id, .state = Visibility::kOutOfView};
  EXPECT_EQ(results.size(), 1U);
  EXPECT_EQ(results.front().object, id);
  return results.front();
}

/// Depth of the columns left of the middle becomes `depth_m`: half of the cube.
void set_left_half(RgbdFrame& frame, float depth_m) {
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 40; ++u) frame.depth_m.at(u, v) = depth_m;
  }
}

TEST(ObjectVisibility, IsVisibleWhereItsSurfaceIsMeasured) {
  World world;
  const VisibilityResult result = evaluate(world, frame_with_depth(2.0F), cube_ahead());
  EXPECT_EQ(result.state, Visibility::kVisible);
  EXPECT_EQ(result.visible_fraction, 1.0);
  EXPECT_EQ(result.absent_fraction, 0.0);
  EXPECT_NEAR(result.distance_m, 2.2, 1e-9);
  EXPECT_NEAR(std::abs(result.bearing_rad), std::numbers::pi, 1e-9);
}

TEST(ObjectVisibility, IsAbsentWhereTheCameraLooksThrough) {
  World world;
  const VisibilityResult result = evaluate(world, frame_with_depth(4.0F), cube_ahead());
  EXPECT_EQ(result.state, Visibility::kAbsent);
  EXPECT_EQ(result.absent_fraction, 1.0);
}

TEST(ObjectVisibility, IsOccludedBehindSomethingMeasuredInFront) {
  World world;
  EXPECT_EQ(evaluate(world, frame_with_depth(1.0F), cube_ahead()).state, Visibility::kOccluded);
}

TEST(ObjectVisibility, IsPartlyOccludedWhenHalfOfItIsHidden) {
  World world;
  RgbdFrame frame = frame_with_depth(2.0F);
  set_left_half(frame, 1.0F);
  const VisibilityResult result = evaluate(world, frame, cube_ahead());
  EXPECT_EQ(result.state, Visibility::kPartlyOccluded);
  EXPECT_NEAR(result.visible_fraction, 0.5, 0.15);
}

TEST(ObjectVisibility, IsAbsentWhenTheOpenHalfIsSeenThrough) {
  World world;
  RgbdFrame frame = frame_with_depth(4.0F);
  set_left_half(frame, 1.0F);
  EXPECT_EQ(evaluate(world, frame, cube_ahead()).state, Visibility::kAbsent);
}

/// At a depth of 2.01 m the image ends 1.005 m left of the middle: of the 20 columns of a cube 1.06
/// m aside 7 lie in it, of one 0.92 m aside 14.
TEST(ObjectVisibility, IsNotAbsentWhereOnlyItsRimInTheImageIsSeenThrough) {
  World world;
  const RgbdFrame frame = frame_with_depth(4.0F);
  EXPECT_EQ(evaluate(world, frame, cube_ahead(1.06)).state, Visibility::kOutOfView);
  EXPECT_EQ(evaluate(world, frame, cube_ahead(0.92)).state, Visibility::kAbsent);
  EXPECT_EQ(evaluate(world, frame_with_depth(2.0F), cube_ahead(1.06)).state, Visibility::kVisible);
}

TEST(ObjectVisibility, IsOutOfViewBesideTheImageBehindTheCameraAndBeyondTheRange) {
  World world;
  const RgbdFrame frame = frame_with_depth(2.0F);
  EXPECT_EQ(evaluate(world, frame, cube_ahead(3.0)).state, Visibility::kOutOfView);
  Object behind = cube_ahead();
  behind.points = {};
  behind.box = {{-2.4, -0.2, -0.2}, {-2.0, 0.2, 0.2}};
  EXPECT_EQ(evaluate(world, frame, behind).state, Visibility::kOutOfView);
  Object far = cube_ahead();
  far.points = {};
  far.box = {{5.2, -0.2, -0.2}, {5.6, 0.2, 0.2}};
  EXPECT_EQ(evaluate(world, frame, far).state, Visibility::kOutOfView);
}

TEST(ObjectVisibility, ItsOwnNearSideDoesNotHideItsFarSide) {
  // Points of the far side only, as once seen from behind; the measured near side is 0.39 m nearer.
  World world;
  Object object = cube_ahead();
  object.points = {};
  object.points.observe(row_of_points(2.39F));
  EXPECT_EQ(evaluate(world, frame_with_depth(2.0F), object).state, Visibility::kVisible);
}

/// A cube of 0.4 m of which only the far side has points, detected from a bearing so far to the
/// side of the camera's.
Object far_side_of_cube(double aside_rad) {
  Object object = cube_ahead();
  object.points = {};
  object.points.observe(row_of_points(2.39F));
  const double bearing_rad = bearing_from_object_rad(object.centroid_in_map, {0, 0, 0});
  object.observation_log.add({.bearing_rad = static_cast<float>(bearing_rad + aside_rad)});
  return object;
}

TEST(ObjectVisibility, WhatReachesIntoItsBoxHidesItWhereItsNearSideIsKnown) {
  World world;
  const RgbdFrame near_side = frame_with_depth(2.0F);
  for (const double aside_deg : {0.0, 35.0, -35.0}) {
    const Object object = far_side_of_cube(aside_deg * std::numbers::pi / 180);
    const VisibilityResult result = evaluate(world, near_side, object);
    EXPECT_EQ(result.state, Visibility::kOccluded) << aside_deg;
    EXPECT_EQ(result.visible_fraction, 0.0) << aside_deg;
    EXPECT_EQ(evaluate(world, frame_with_depth(2.39F), object).state, Visibility::kVisible);
  }
  for (const double aside_deg : {65.0, -65.0, 180.0}) {
    const Object object = far_side_of_cube(aside_deg * std::numbers::pi / 180);
    EXPECT_EQ(evaluate(world, near_side, object).state, Visibility::kVisible)
        << "that may be its own: " << aside_deg;
  }
}

TEST(ObjectVisibility, PointsOfItsNearSideMakeThatItsOwn) {
  World world;
  Object object = far_side_of_cube(0.0);
  object.points.observe(row_of_points(2.01F));
  const VisibilityResult result = evaluate(world, frame_with_depth(2.0F), object);
  EXPECT_EQ(result.state, Visibility::kVisible);
  EXPECT_EQ(result.visible_fraction, 1.0);
}

TEST(ObjectVisibility, WhereNothingIsMeasuredTheMapTellsWhatMustHideIt) {
  // [smap] figure 3.23 asks the frame alone. Here a known wall at 1 m stands where depth has a
  // hole.
  World world;
  auto tree = SemanticOctree::create({.resolution_m = 0.05}).value();
  FrameIntegrator integrator;
  RgbdFrame wall = frame_with_depth(1.0F);
  ASSERT_TRUE(integrator.integrate(tree, wall, {}, {}));
  ASSERT_TRUE(world.scene.update(tree));
  EXPECT_EQ(evaluate(world, frame_with_depth(0.0F), cube_ahead()).state, Visibility::kOccluded);
}

TEST(ObjectVisibility, WhereNothingIsMeasuredAndNothingHidesNothingCanBeTold) {
  World world;
  EXPECT_EQ(evaluate(world, frame_with_depth(0.0F), cube_ahead()).state, Visibility::kOutOfView);
  RgbdFrame frame = frame_with_depth(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(evaluate(world, frame, cube_ahead()).state, Visibility::kOutOfView);
}

TEST(ObjectVisibility, TheMapIsAskedOnceAndOnlyAboutWhatWasNotMeasured) {
  World world;
  EXPECT_EQ(evaluate(world, frame_with_depth(2.0F), cube_ahead()).state, Visibility::kVisible);
  EXPECT_EQ(world.num_questions, 0);
  EXPECT_EQ(evaluate(world, frame_with_depth(0.0F), cube_ahead()).state, Visibility::kOutOfView);
  EXPECT_EQ(world.num_questions, 1);

  const auto refuse = [](std::span<const OcclusionRay>) -> Result<std::vector<std::uint8_t>> {
    return fail(ErrorCode::kOutOfMemory, "no memory for the occlusion scene");
  };
  const auto results = evaluate_visibility(world.objects, frame_with_depth(0.0F), refuse);
  ASSERT_FALSE(results);
  EXPECT_EQ(results.error().code, ErrorCode::kOutOfMemory);
}

TEST(ObjectVisibility, WhatWasDetectedInThisFrameIsNeverHiddenOrGone) {
  World world;
  const std::vector<ObjectId> seen{ObjectId{1}};
  EXPECT_EQ(evaluate(world, frame_with_depth(4.0F), cube_ahead(), seen).state,
            Visibility::kVisible);
  EXPECT_EQ(evaluate(world, frame_with_depth(1.0F), cube_ahead(), seen).state,
            Visibility::kVisible);
}

TEST(ObjectVisibility, AnObjectWithoutPointsIsJudgedByItsBox) {
  World world;
  Object object = cube_ahead();
  object.points = {};
  EXPECT_EQ(evaluate(world, frame_with_depth(2.0F), object).state, Visibility::kVisible);
  EXPECT_EQ(evaluate(world, frame_with_depth(4.0F), object).state, Visibility::kAbsent);
}

TEST(ObjectVisibility, VerdictsComeByAscendingId) {
  World world;
  for (int i = 0; i < 5; ++i) world.objects.add(cube_ahead(0.1 * i));
  const auto results =
      evaluate_visibility(world.objects, frame_with_depth(2.0F), world.answer()).value();
  ASSERT_EQ(results.size(), 5U);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(results[i].object, ObjectId{i + 1});
}

TEST(ObjectVisibility, OptionsOutOfRangeAreNamed) {
  const auto field_of = [](const VisibilityOptions& options) {
    const auto result = validate(options);
    return result ? std::string("none") : result.error().field;
  };
  EXPECT_EQ(field_of({}), "none");
  EXPECT_EQ(field_of({.max_rays = 0}), "max_rays");
  EXPECT_EQ(field_of({.max_range_m = 0.0}), "max_range_m");
  EXPECT_EQ(field_of({.depth_tolerance_m = -1.0}), "depth_tolerance_m");
  EXPECT_EQ(field_of({.absent_share = 1.5}), "absent_share");
}

}  // namespace
}  // namespace hypermap
