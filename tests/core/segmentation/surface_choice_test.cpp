// SPDX-License-Identifier: BSD-3-Clause
// Which of the surfaces in a detection's box are the object, when others are larger in it.
#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using test::BoxScene;
using test::detection_of;
using test::kChair;
using test::kCupboard;
using test::kFloor;
using test::kTable;
using test::kWall;
using test::SceneView;

BoxScene room() {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {5, -4, 0}, {5.1, 4, 3});
  return scene;
}

/// Nearest place of what is found of a narrow table behind a desk that fills more of its box and
/// reaches beyond that by so much of its width.
double begin_behind_a_desk_m(double overhang_share) {
  BoxScene scene = room();
  scene.add(kTable, {3.6, -0.8, 0.73}, {3.9, 0.8, 0.75});
  for (const double y : {-0.8, 0.75}) scene.add(kTable, {3.6, y, 0}, {3.65, y + 0.05, 0.73});
  const double right_m = 2.2 / 3.6 * 0.8 * (1.0 + 2.0 * overhang_share);
  scene.add(kCupboard, {2.2, -right_m, 0.7}, {3.2, 0.45, 0.72});
  for (const double y : {-right_m, 0.4}) scene.add(kCupboard, {2.2, y, 0}, {2.25, y + 0.05, 0.7});
  const SceneView view = scene.view(test::look_at({0, 0, 1.3}, {3, 0, 0.6}), 1);
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  return found ? found->box.min_in_map.x() : 0.0;
}

TEST(SurfaceChoice, PrefersWhatEndsWithTheBoxToWhatReachesBeyondIt) {
  EXPECT_GT(begin_behind_a_desk_m(0.22), 3.5);
  EXPECT_GT(begin_behind_a_desk_m(0.28), 3.5);
}

/// What is found in a box that shows the back of a chair, which another box is about, over so much
/// of a desk.
Result<Segment> found_over_a_desk(double desk_share) {
  BoxScene scene = room();
  scene.add(kTable, {0.7, -2, 0.7}, {2.2, 2, 0.72});
  scene.add(kChair, {2.6, -0.25, 0.4}, {2.65, 0.25, 0.75});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {1.8, 0, 0.8}));
  const Detection chair = detection_of(view, kChair);
  Detection other = chair;
  const double rows = chair.box_px.v_max_px - chair.box_px.v_min_px;
  other.box_px.v_max_px += rows * desk_share / (1.0 - desk_share);
  const std::vector<Detection> both{other, chair};
  return segment_all(view.frame, both, {}, 1).front();
}

TEST(SurfaceChoice, TakesNoSupportForTheObjectWhereOthersStandOutOfIt) {
  EXPECT_FALSE(found_over_a_desk(0.7).has_value());
  EXPECT_TRUE(found_over_a_desk(0.87).has_value()) << "a flat thing with something on it";
}

/// Share of the floor in what is found of a chair between two chests, before it a third: the floor
/// is seen under the chair and in a wedge beside the third. 0 when nothing is found.
double floor_share_under_a_chair(int max_planes) {
  BoxScene scene = room();
  for (const double y : {-0.25, 0.2}) {
    scene.add(kChair, {2.0, y, 0}, {2.05, y + 0.05, 1.0});
    scene.add(kChair, {2.4, y, 0}, {2.45, y + 0.05, 0.42});
  }
  scene.add(kChair, {2.0, -0.2, 0.6}, {2.03, 0.2, 1.0});
  scene.add(kChair, {2.0, -0.25, 0.42}, {2.45, 0.25, 0.46});
  scene.add(kCupboard, {1.2, -1.6, 0}, {3.2, -0.35, 0.5});
  scene.add(kCupboard, {1.2, 0.35, 0}, {3.2, 1.6, 0.6});
  scene.add(kCupboard, {0.9, -0.35, 0}, {1.5, 0.15, 0.3});
  const SceneView view = scene.view(test::look_at({0, 0, 1.4}, {2.0, 0, 0.6}), 1);
  GeometricSegmentationOptions options;
  options.foreground.max_planes = max_planes;
  const auto found = segment(view.frame, detection_of(view, kChair), options);
  if (!found) return 0.0;
  const auto num_floor = std::count_if(
      found->pixel_indices.begin(), found->pixel_indices.end(), [&](std::uint32_t pixel) {
        return view.truth.pixels()[pixel] == kFloor;
      });
  return static_cast<double>(num_floor) / static_cast<double>(found->pixel_indices.size());
}

TEST(SurfaceChoice, LacksAFloorThatIsHardlySeenBesideTheBox) {
  EXPECT_LT(floor_share_under_a_chair(5), 0.02);
  EXPECT_GT(floor_share_under_a_chair(0), 0.2) << "without a search for planes";
}

}  // namespace
}  // namespace hypermap
