// SPDX-License-Identifier: BSD-3-Clause
// What carries an object is no part of it, also where the sensor bends it.
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

using test::BoxScene;
using test::SceneView;

constexpr int kCarrier = 1;
constexpr int kCarried = 2;

MapFromCamera from_above() {
  return test::look_at({0, 0, 1.5}, {1.6, 0, 0.2});
}

/// Depth that is up to `most_m` too small around column `middle_u`, as a structured-light sensor's
/// is: the error comes and goes over 100 pixels.
SceneView bent(SceneView view, int middle_u, double most_m) {
  constexpr int kHalfWidthPx = 100;
  DepthImage& depth_m = view.frame.depth_m;
  const int begin = std::max(0, middle_u - kHalfWidthPx);
  const int end = std::min(depth_m.width_px(), middle_u + kHalfWidthPx);
  for (int v = 0; v < depth_m.height_px(); ++v) {
    for (int u = begin; u < end; ++u) {
      const double phase = std::numbers::pi * (u - middle_u) / kHalfWidthPx;
      depth_m.at(u, v) -= static_cast<float>(most_m * 0.5 * (1.0 + std::cos(phase)));
    }
  }
  return view;
}

int right_edge_u(const SceneView& view) {
  return static_cast<int>(test::tight_box(view.truth, kCarried).value().u_max_px);
}

/// The object's box, `margin_px` wider on each side, as a detector may give it.
Detection wide_detection(const SceneView& view, double margin_px) {
  PixelBox box = test::tight_box(view.truth, kCarried).value();
  box.u_min_px -= margin_px;
  box.v_min_px -= margin_px;
  box.u_max_px += margin_px;
  box.v_max_px += margin_px;
  Detection detection;
  detection.box_px = box;
  return detection;
}

std::size_t num_of(const Segment& segment, const SceneView& view, int label) {
  return static_cast<std::size_t>(std::count_if(
      segment.pixel_indices.begin(), segment.pixel_indices.end(), [&](std::uint32_t pixel) {
        return view.truth.pixels()[pixel] == label;
      }));
}

double share_found(const Segment& segment, const SceneView& view) {
  const auto all = std::count(view.truth.pixels().begin(), view.truth.pixels().end(), kCarried);
  return static_cast<double>(num_of(segment, view, kCarried)) / static_cast<double>(all);
}

TEST(PlaneGrowth, AFloorThatTheSensorBendsIsNoPartOfTheCabinetOnIt) {
  BoxScene scene;
  scene.add(kCarrier, {-4, -4, -0.1}, {6, 4, 0}).add(kCarried, {1.4, -0.3, 0}, {1.8, 0.3, 0.5});
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SceneView flat = scene.view(from_above(), seed);
    const SceneView view = bent(flat, right_edge_u(flat) + 20, 0.037);
    const auto found = segment(view.frame, wide_detection(view, 45), {});
    ASSERT_TRUE(found.has_value());
    EXPECT_GE(share_found(*found, view), 0.95);
    EXPECT_LE(num_of(*found, view, kCarrier), found->pixel_indices.size() / 50) << "seed " << seed;
  }
}

TEST(PlaneGrowth, AThinFootKeepsWhatRisesFromItsSupportAtAnEdge) {
  // A screen on a plate of 3 cm on a table, 1 m away.
  BoxScene scene;
  scene.add(kCarrier, {0.4, -1, 0.6}, {2, 1, 0.7});
  scene.add(kCarried, {0.8, -0.15, 0.7}, {1.0, 0.15, 0.73});
  scene.add(kCarried, {0.95, -0.25, 0.78}, {1.0, 0.25, 1.1});
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SceneView view = scene.view(test::look_at({0, 0, 1.3}, {0.95, 0, 0.85}), seed);
    const auto found = segment(view.frame, wide_detection(view, 4), {});
    ASSERT_TRUE(found.has_value());
    EXPECT_GE(share_found(*found, view), 0.9) << "seed " << seed;
  }
}

TEST(PlaneGrowth, AFlatThingStaysOnATableThatIsBent) {
  BoxScene scene;
  scene.add(kCarrier, {0.4, -1, 0.6}, {2, 1, 0.7});
  scene.add(kCarried, {0.8, -0.2, 0.7}, {1.0, 0.1, 0.73});
  const SceneView flat = scene.view(test::look_at({0, 0, 1.3}, {0.95, 0, 0.7}), 1);
  const SceneView view = bent(flat, right_edge_u(flat), 0.02);
  const auto found = segment(view.frame, wide_detection(view, 4), {});
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(share_found(*found, view), 0.8);
}

}  // namespace
}  // namespace hypermap
