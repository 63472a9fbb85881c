// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene_renderer.hpp"

#include "hypermap/io/simulator/scene_file.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

using Eigen::Vector3d;

constexpr PinholeCamera kCamera{64, 48, 50.0, 50.0, 31.5, 23.5};

PlacedObject box_object(std::uint32_t id, const Vector3d& min, const Vector3d& max) {
  PlacedObject object;
  object.id = ObjectId{id};
  object.name = "box" + std::to_string(id);
  object.class_name = "suitcase";
  object.mesh =
      MeshBuilder().material({{200, 40, 40}, SurfacePattern::kPlain}).box(min, max).build();
  object.box = {min, max};
  return object;
}

/// A wall at x = 4 before a camera at the origin that looks along +x.
FurnishedScene wall_scene() {
  FurnishedScene scene;
  scene.room = MeshBuilder().box({4, -50, -50}, {5, 50, 50}).build();
  scene.lights_in_map = {{0, 0, 2}};
  return scene;
}

RenderedView view_of(const FurnishedScene& scene, const PinholeCamera& camera = kCamera) {
  const auto renderer = SceneRenderer::create(scene);
  EXPECT_TRUE(renderer) << to_string(renderer.error());
  return renderer->render(camera, look_at({0, 0, 0}, {1, 0, 0}));
}

TEST(SceneRenderer, AWallSquareToTheCameraHasOneDepth) {
  // Depth is along the optical axis, so the corners of the image are no farther than its middle.
  const RenderedView view = view_of(wall_scene());
  for (const float depth : view.depth_m.pixels()) EXPECT_NEAR(depth, 4.0F, 1e-5F);
  for (const ObjectId id : view.instances.pixels()) EXPECT_EQ(id, kNoObject);
}

TEST(SceneRenderer, IncidenceIsTheAngleBetweenRayAndNormal) {
  const RenderedView view = view_of(wall_scene());
  // At pixel (u, v) the ray is (x, y, 1) with x = (u - 31.5) / 50, so cos = 1 / |(x, y, 1)|.
  const double x = (0 - 31.5) / 50.0;
  const double y = (0 - 23.5) / 50.0;
  EXPECT_NEAR(view.incidence_cos.at(0, 0), 1.0 / std::sqrt(1.0 + x * x + y * y), 1e-6);
  EXPECT_NEAR(view.incidence_cos.at(31, 23), 1.0, 3e-4);
}

TEST(SceneRenderer, ABoxCoversThePixelsThatItsProjectionCovers) {
  FurnishedScene scene = wall_scene();
  scene.objects.push_back(box_object(1, {2.0, -0.2, -0.1}, {2.1, 0.2, 0.1}));
  const RenderedView view = view_of(scene);
  // At 2 m: u = 31.5 +- 50 * 0.2 / 2 = 26.5 .. 36.5: pixels 27 .. 36; v = 23.5 +- 2.5: 21 .. 26,
  // where pixel centres at whole numbers lie on the edge at 26.5 and 36.5 never.
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const bool inside = u >= 27 && u <= 36 && v >= 21 && v <= 26;
      EXPECT_EQ(view.instances.at(u, v) == ObjectId{1}, inside) << u << " " << v;
      EXPECT_NEAR(view.depth_m.at(u, v), inside ? 2.0F : 4.0F, 1e-5F);
    }
  }
}

TEST(SceneRenderer, NearerThingsHideFartherOnes) {
  FurnishedScene scene = wall_scene();
  scene.objects.push_back(box_object(1, {3.0, -1, -1}, {3.1, 1, 1}));
  scene.objects.push_back(box_object(2, {2.0, -1, -1}, {2.1, 1, 1}));
  const RenderedView view = view_of(scene);
  EXPECT_EQ(std::ranges::count(view.instances.pixels(), ObjectId{1}), 0);
  EXPECT_GT(std::ranges::count(view.instances.pixels(), ObjectId{2}), 0);
}

TEST(SceneRenderer, WhereNothingIsHitEverythingIsZero) {
  FurnishedScene scene;
  scene.objects.push_back(box_object(1, {2.0, -0.2, -0.1}, {2.1, 0.2, 0.1}));
  const RenderedView view = view_of(scene);
  EXPECT_EQ(view.depth_m.at(0, 0), 0.0F);
  EXPECT_EQ(view.incidence_cos.at(0, 0), 0.0F);
  EXPECT_EQ(view.color.at(0, 0), Rgb8{});
}

TEST(SceneRenderer, WhatBlocksALampCastsAShadow) {
  // A board above the light path: the wall below the lamp's height behind it is darker.
  FurnishedScene scene = wall_scene();
  const RenderedView bright = view_of(scene);
  scene.objects.push_back(box_object(1, {1.0, -3, 1.0}, {1.1, 3, 1.9}));  // above the view
  const RenderedView shaded = view_of(scene);
  int darker = 0;
  for (int v = 0; v < 48; ++v) {
    EXPECT_EQ(shaded.instances.at(32, v), kNoObject);
    EXPECT_LE(shaded.color.at(32, v).g, bright.color.at(32, v).g);
    darker += shaded.color.at(32, v).g < bright.color.at(32, v).g - 20 ? 1 : 0;
  }
  EXPECT_GT(darker, 10);
}

TEST(SceneRenderer, TheUnhiddenShareOfAFreeThingIsOne) {
  FurnishedScene scene = wall_scene();
  scene.objects.push_back(box_object(1, {2.0, -0.4, -0.4}, {2.1, 0.4, 0.4}));
  const auto renderer = SceneRenderer::create(scene);
  ASSERT_TRUE(renderer);
  const MapFromCamera pose = look_at({0, 0, 0}, {1, 0, 0});
  const RenderedView view = renderer->render(kCamera, pose);
  const auto shares = renderer->unhidden_shares(view, std::array{ObjectId{1}}, kCamera, pose);
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_DOUBLE_EQ(shares[0], 1.0);
}

TEST(SceneRenderer, AThingHalfBehindAnotherIsHalfUnhidden) {
  FurnishedScene scene = wall_scene();
  scene.objects.push_back(box_object(1, {2.0, -0.4, -0.4}, {2.01, 0.4, 0.4}));
  scene.objects.push_back(box_object(2, {1.0, 0.0, -0.9}, {1.01, 0.9, 0.9}));  // hides y > 0
  const auto renderer = SceneRenderer::create(scene);
  ASSERT_TRUE(renderer);
  const MapFromCamera pose = look_at({0, 0, 0}, {1, 0, 0});
  const RenderedView view = renderer->render(kCamera, pose);
  const auto shares = renderer->unhidden_shares(view, std::array{ObjectId{1}}, kCamera, pose);
  EXPECT_NEAR(shares[0], 0.5, 0.03);
}

TEST(SceneRenderer, WhatTheImageCutsOffCountsAsHidden) {
  FurnishedScene scene = wall_scene();
  // At 2 m the image reaches to y = -(63.5 - 31.5) / 50 * 2 = -1.28; the object from -0.88 to
  // -1.68 is cut in the middle.
  scene.objects.push_back(box_object(1, {2.0, -1.68, -0.4}, {2.01, -0.88, 0.4}));
  const auto renderer = SceneRenderer::create(scene);
  ASSERT_TRUE(renderer);
  const MapFromCamera pose = look_at({0, 0, 0}, {1, 0, 0});
  const RenderedView view = renderer->render(kCamera, pose);
  const auto shares = renderer->unhidden_shares(view, std::array{ObjectId{1}}, kCamera, pose);
  EXPECT_NEAR(shares[0], 0.5, 0.06);
}

TEST(SceneRenderer, AnyNumberOfThreadsGivesTheSameImage) {
  const auto scene = load_scene(test::source_path("data/scenes/laboratory.yaml"));
  ASSERT_TRUE(scene) << to_string(scene.error());
  const auto furnished = furnish(*scene, 1);
  ASSERT_TRUE(furnished);
  const auto renderer = SceneRenderer::create(*furnished);
  ASSERT_TRUE(renderer);
  constexpr PinholeCamera kSmall{161, 120, 131.0, 131.0, 80.0, 59.5};  // no multiple of a packet
  const MapFromCamera pose = look_at({-1.9, -1.6, 1.4}, {-0.3, 0.2, 0.5});
  const auto on = [&](int threads) {
    tbb::task_arena arena(std::min(threads, tbb::this_task_arena::max_concurrency()));
    return arena.execute([&] { return renderer->render(kSmall, pose); });
  };
  const RenderedView one = on(1);
  const RenderedView more = on(4);
  EXPECT_EQ(one.depth_m, more.depth_m);
  EXPECT_EQ(one.incidence_cos, more.incidence_cos);
  EXPECT_EQ(one.instances, more.instances);
  EXPECT_EQ(one.color, more.color);
  // A furnished room is closed: every ray meets something.
  EXPECT_EQ(std::ranges::count(one.depth_m.pixels(), 0.0F), 0);
}

}  // namespace
}  // namespace hypermap
