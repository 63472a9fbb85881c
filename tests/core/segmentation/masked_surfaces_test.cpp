// SPDX-License-Identifier: BSD-3-Clause
// What of a segmentation network's mask is the object: masks are some pixels off, and filled.
#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/core/segmentation/segmentation_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using test::BoxScene;
using test::detection_of;
using test::kChair;
using test::kCup;
using test::kCupboard;
using test::kFloor;
using test::kScreen;
using test::kTable;
using test::kWall;
using test::SceneView;

/// The pixels of a solid, moved.
MaskImage mask_of(const SceneView& view, int label, int du_px = 0, int dv_px = 0) {
  MaskImage mask(view.truth.width_px(), view.truth.height_px());
  for (int v = 0; v < mask.height_px(); ++v) {
    for (int u = 0; u < mask.width_px(); ++u) {
      const int from_u = u - du_px;
      const int from_v = v - dv_px;
      if (from_u < 0 || from_v < 0 || from_u >= mask.width_px() || from_v >= mask.height_px())
        continue;
      mask.at(u, v) = view.truth.at(from_u, from_v) == label ? 1 : 0;
    }
  }
  return mask;
}

/// All between the first and the last pixel of each row.
MaskImage filled(MaskImage mask) {
  for (int v = 0; v < mask.height_px(); ++v) {
    int first = 0;
    int last = mask.width_px() - 1;
    while (first < last && mask.at(first, v) == 0) ++first;
    while (last > first && mask.at(last, v) == 0) --last;
    if (mask.at(first, v) == 0) continue;
    for (int u = first; u <= last; ++u) mask.at(u, v) = 1;
  }
  return mask;
}

Result<Segment> segment_of(const SceneView& view, int label, MaskImage mask) {
  Detection detection = detection_of(view, label);
  detection.mask = std::move(mask);
  return segment(view.frame, detection, {});
}

/// Pixels of the segment that show that solid.
double num_showing(const SceneView& view, const Segment& segment, int label) {
  return static_cast<double>(std::count_if(
      segment.pixel_indices.begin(), segment.pixel_indices.end(), [&](std::uint32_t pixel) {
        return view.truth.pixels()[pixel] == label;
      }));
}

double num_pixels(const SceneView& view, int label) {
  return static_cast<double>(
      std::count(view.truth.pixels().begin(), view.truth.pixels().end(), label));
}

TEST(MaskedSurfaces, AStripOfTheWallBesideAMaskThatIsOffIsNotTheScreen) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const SceneView view = test::office_view(seed);
    const auto found = segment_of(view, kScreen, mask_of(view, kScreen, 4, -3));
    ASSERT_TRUE(found.has_value()) << to_string(found.error());
    EXPECT_GE(num_showing(view, *found, kScreen), 0.85 * num_pixels(view, kScreen));
    EXPECT_LE(num_showing(view, *found, kWall), 0.005 * num_pixels(view, kScreen));
  }
}

TEST(MaskedSurfaces, AStripOfWhatStandsBeforeItIsNotTheCupboard) {
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kWall, {3.6, -3, 0}, {3.7, 3, 3});
  scene.add(kCupboard, {3, -0.6, 0}, {3.6, 0.6, 1.4}).add(kTable, {1.6, -1, 0}, {1.9, 1, 0.6});
  const SceneView view = scene.view(test::look_at({0, 0, 1}, {3, 0, 0.7}), 1);
  const auto found = segment_of(view, kCupboard, mask_of(view, kCupboard, 0, 5));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kCupboard), 0.95 * num_pixels(view, kCupboard));
  EXPECT_EQ(num_showing(view, *found, kTable), 0.0);
  EXPECT_GT(found->box.min_in_map.x(), 2.9);
}

TEST(MaskedSurfaces, ASmallThingLosesTheStripsToo) {
  const SceneView view = test::office_view(2);
  const auto found = segment_of(view, kCup, mask_of(view, kCup, 2, 2));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kCup), 0.75 * num_pixels(view, kCup));
  EXPECT_LE(static_cast<double>(found->pixel_indices.size()) - num_showing(view, *found, kCup),
            0.05 * num_pixels(view, kCup));
}

/// A chair of four legs before a wall, seen from its front.
SceneView chair_view() {
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kWall, {4, -3, 0}, {4.1, 3, 3});
  scene.add(kChair, {1.8, -0.25, 0.42}, {2.3, 0.25, 0.47});
  scene.add(kChair, {2.25, -0.25, 0.47}, {2.3, 0.25, 0.9});
  for (const double x : {1.8, 2.26}) {
    for (const double y : {-0.25, 0.21}) {
      scene.add(kChair, {x, y, 0}, {x + 0.04, y + 0.04, 0.42});
    }
  }
  return scene.view(test::look_at({0, 0, 1.2}, {2, 0, 0.4}), 1);
}

TEST(MaskedSurfaces, TheFloorBetweenTheLegsOfAFilledMaskIsNotTheChair) {
  const SceneView view = chair_view();
  const auto found = segment_of(view, kChair, filled(mask_of(view, kChair)));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kChair), 0.93 * num_pixels(view, kChair));
  EXPECT_LE(num_showing(view, *found, kFloor), 0.01 * num_pixels(view, kChair));
  EXPECT_NEAR(found->box.min_in_map.z(), 0.0, 0.03) << "the feet are there";
}

TEST(MaskedSurfaces, AnExactMaskLosesNothing) {
  const SceneView view = chair_view();
  const auto found = segment_of(view, kChair, mask_of(view, kChair));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kChair), 0.97 * num_pixels(view, kChair));
}

TEST(MaskedSurfaces, AFlatThingIsItsWholeMask) {
  BoxScene scene;
  scene.add(kTable, {0.5, -2, 0.7}, {4, 2, 0.75});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2, 0, 0.75}));
  Detection sheet;
  sheet.mask = MaskImage(640, 480);
  for (int v = 220; v < 260; ++v) std::fill_n(&sheet.mask->at(300, v), 40, std::uint8_t{1});
  const auto found = segment(view.frame, sheet, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->pixel_indices.size(), 40U * 40U);
}

TEST(MaskedSurfaces, OfTwoCupboardsWithFrontsInOnePlaneEachHasItsOwn) {
  constexpr int kOther = 9;
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kWall, {2.6, -3, 0}, {2.7, 3, 3});
  scene.add(kCupboard, {2, -0.6, 0}, {2.6, 0, 1.2}).add(kOther, {2, 0, 0}, {2.6, 0.9, 1.2});
  const SceneView view = scene.view(test::look_at({0, 0, 1}, {2, 0, 0.7}), 1);
  const auto found = segment_of(view, kCupboard, mask_of(view, kCupboard));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kCupboard), 0.97 * num_pixels(view, kCupboard));
  EXPECT_EQ(num_showing(view, *found, kOther), 0.0);
}

TEST(MaskedSurfaces, AMaskWithoutDepthFindsNothing) {
  SceneView view = test::office_view(1);
  MaskImage mask = mask_of(view, kScreen);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.pixels()[i] != 0) view.frame.depth_m.pixels()[i] = 0.0F;
  }
  EXPECT_EQ(segment_of(view, kScreen, std::move(mask)).error().code, ErrorCode::kNotFound);
}

TEST(MaskedSurfaces, AnEmptyMaskFindsNothing) {
  const SceneView view = test::office_view(1);
  EXPECT_EQ(segment_of(view, kScreen, MaskImage(640, 480)).error().code, ErrorCode::kNotFound);
}

TEST(MaskedSurfaces, AFlatThingBehindAPostStaysWhole) {
  constexpr int kPost = 9;
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kTable, {1.8, -0.6, 0}, {2.75, 0.6, 0.005});
  const auto camera = test::look_at({0, 0, 1.4}, {2.2, 0, 0});
  const SceneView alone = scene.view(camera, 1);
  scene.add(kPost, {1.2, 0.05, 0}, {1.26, 0.11, 1.6});
  const SceneView view = scene.view(camera, 1);
  const auto found = segment_of(view, kTable, mask_of(view, kTable));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(num_showing(view, *found, kTable), 0.95 * num_pixels(view, kTable));
  EXPECT_EQ(num_showing(view, *found, kPost), 0.0);
  const auto unhidden = segment_of(alone, kTable, mask_of(alone, kTable));
  ASSERT_TRUE(unhidden.has_value());
  EXPECT_NEAR(found->box.extent().y(), unhidden->box.extent().y(), 0.03);
}

/// Half of a mask on the floor, half on the wall, its left edge on a post before both.
TEST(MaskedSurfaces, AMaskOfNothingButBackgroundAndAStripStaysWhole) {
  constexpr int kPost = 9;
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kWall, {3, -3, 0}, {3.1, 3, 3});
  scene.add(kPost, {1.5, 0.3, 0}, {1.6, 0.5, 2.5});
  const SceneView view = scene.view(test::look_at({0, 0, 0.6}, {3, 0, 0.6}));
  int end_of_post = 639;
  while (view.truth.at(end_of_post, 345) != kPost) --end_of_post;
  MaskImage mask(640, 480);
  for (int v = 295; v < 395; ++v) std::fill_n(&mask.at(end_of_post - 3, v), 100, std::uint8_t{1});
  const auto found = segment_of(view, kPost, std::move(mask));
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(found->pixel_indices.size(), 100U * 100U * 9U / 10U);
}

TEST(MaskedSurfaces, AThinThingIsAllEdgeAndStays) {
  BoxScene scene;
  scene.add(kTable, {0.5, -2, 0.7}, {4, 2, 0.75});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2, 0, 0.75}), 1);
  Detection ski;
  ski.mask = MaskImage(640, 480);
  for (int v = 220; v < 226; ++v) std::fill_n(&ski.mask->at(200, v), 200, std::uint8_t{1});
  const auto found = segment(view.frame, ski, {});
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(found->pixel_indices.size(), 6U * 200U * 9U / 10U);
}

TEST(MaskedSurfaces, TheMaskIsAStepOfItsOwn) {
  const SceneView view = test::office_view(1);
  Detection detection = detection_of(view, kScreen);
  const auto names = [&] {
    std::string all;
    for (const SegmentationStep& step : trace_segmentation(view.frame, detection, {}).steps)
      all += step.name + " ";
    return all;
  };
  EXPECT_EQ(names(), "window planes surfaces object ");
  detection.mask = mask_of(view, kScreen);
  EXPECT_EQ(names(), "window planes mask surfaces object ");
  detection.mask = MaskImage(640, 480);
  EXPECT_EQ(segment(view.frame, detection, {}).error().what,
            "no point was left after the step mask");
}

/// A table whose top was not measured and leaves the image at its upper edge.
SceneView table_at_the_edge() {
  BoxScene scene;
  scene.add(kFloor, {0.5, -4, -0.1}, {8, 4, 0}).add(kTable, {2.1, -0.8, 0}, {7, 0.8, 0.75});
  SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2.1, 0, -0.25}), 1);
  const Eigen::Isometry3d map_from_camera = view.frame.map_from_camera.isometry();
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double depth_m = static_cast<double>(view.frame.depth_m.at(u, v));
      const Eigen::Vector3d point =
          map_from_camera * view.frame.camera.unproject(u, v, depth_m).xyz;
      if (view.truth.at(u, v) == kTable && point.x() > 2.12) view.frame.depth_m.at(u, v) = 0.0F;
    }
  }
  return view;
}

TEST(MaskedSurfaces, AMaskAtTheEdgesOfTheImageIsNoOther) {
  const SceneView view = table_at_the_edge();
  const MaskImage mask = mask_of(view, kTable);
  ASSERT_GT(std::count(mask.pixels().begin(), mask.pixels().begin() + 640, 1), 0);
  const auto found = segment_of(view, kTable, mask);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(found->box.min_in_map.x(), 2.08);
  EXPECT_NEAR(found->box.min_in_map.z(), 0.02, 0.025)
      << "the foot, within what the floor tolerates";
  EXPECT_NEAR(found->box.max_in_map.z(), 0.75, 0.02);
  const SceneView office = test::office_view(1);
  EXPECT_TRUE(segment_of(office, kScreen, MaskImage(640, 480, 1)).has_value());
}

}  // namespace
}  // namespace hypermap
