// SPDX-License-Identifier: BSD-3-Clause
// Which of the surfaces in a detection's box are the object, when others are larger in it.
#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
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

/// How near what is found of a frame of 1.2 x 0.8 m is behind a board, which fills more of its box.
/// Seen from the camera the board is 0.93 m wide and 0.75 m high in the frame's plane, and its
/// middle so far to the right of that of the frame and above it: at 0.135 m to the right it ends
/// with the frame, at 0.025 m above it, too.
double begin_behind_a_board_m(double right_m, double above_m) {
  BoxScene scene = room();
  for (const double y : {-0.6, 0.58}) scene.add(kTable, {3.0, y, 0.6}, {3.05, y + 0.02, 1.4});
  for (const double z : {0.6, 1.38}) scene.add(kTable, {3.0, -0.6, z}, {3.05, 0.6, z + 0.02});
  const double y = -2.0 / 3.0 * right_m;
  const double z = 1.0 + 2.0 / 3.0 * above_m;
  scene.add(kCupboard, {2.0, y - 0.31, z - 0.25}, {2.02, y + 0.31, z + 0.25});
  const SceneView view = scene.view(test::look_at({0, 0, 1.0}, {3, 0, 1.0}), 1);
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  return found ? found->box.min_in_map.x() : 0.0;
}

TEST(SurfaceChoice, PrefersWhatEndsWithTheBoxToWhatReachesBeyondIt) {
  EXPECT_LT(begin_behind_a_board_m(0.255, 0), 2.1) << "beyond it by a tenth of its width";
  EXPECT_GT(begin_behind_a_board_m(0.375, 0), 2.9) << "by a fifth";
  EXPECT_LT(begin_behind_a_board_m(0, 0.105), 2.1) << "by a tenth of its height";
  EXPECT_GT(begin_behind_a_board_m(0, 0.185), 2.9) << "by a fifth";
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
  const auto flat = found_over_a_desk(0.87);
  ASSERT_TRUE(flat.has_value()) << "a flat thing with something on it";
  EXPECT_LT(flat->box.extent().z(), 0.01);
}

/// Share of the floor in what is found of a chair between two chests, before it a third: the floor
/// is seen under the chair and in a wedge beside the third.
std::optional<double> floor_share_under_a_chair(int max_planes) {
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
  if (!found) return std::nullopt;
  const auto num_floor = std::count_if(
      found->pixel_indices.begin(), found->pixel_indices.end(), [&](std::uint32_t pixel) {
        return view.truth.pixels()[pixel] == kFloor;
      });
  return static_cast<double>(num_floor) / static_cast<double>(found->pixel_indices.size());
}

TEST(SurfaceChoice, LacksAFloorThatIsHardlySeenBesideTheBox) {
  EXPECT_LT(floor_share_under_a_chair(5).value(), 0.02);
  EXPECT_GT(floor_share_under_a_chair(0).value(), 0.2) << "without a search for planes";
}

/// Share of the floor in what is found of a table that fills the picture of a low camera, which
/// sees a floor through it, as far as that can be measured.
double floor_share_of_table(std::optional<double> floor_height_m) {
  BoxScene scene;
  scene.add(kFloor, {0, -4, -0.1}, {1.4, 4, 0});
  for (const double y : {-0.365, 0.325}) {
    scene.add(kTable, {0.6, y, 0}, {0.64, y + 0.04, 0.75});
    scene.add(kTable, {1.2, y, 0}, {1.24, y + 0.04, 0.75});
  }
  scene.add(kTable, {1.2, -0.365, 0.65}, {1.24, 0.365, 0.75});
  SceneView view = scene.view(test::look_at({0, 0, 0.45}, {1.5, 0, 0.4}), 1);
  view.frame.floor_height_m = floor_height_m;
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  if (!found) return -1.0;
  const auto num_floor = std::count_if(
      found->pixel_indices.begin(), found->pixel_indices.end(), [&](std::uint32_t pixel) {
        return view.truth.pixels()[pixel] == kFloor;
      });
  return static_cast<double>(num_floor) / static_cast<double>(found->pixel_indices.size());
}

TEST(SurfaceChoice, LacksAFloorInsideTheBoxWhereItIsKnown) {
  EXPECT_LT(floor_share_of_table(0.0), 0.001);
  EXPECT_LT(floor_share_of_table(0.06), 0.001) << "a voxel off";
  EXPECT_GT(floor_share_of_table(std::nullopt), 0.2) << "it may be a bed";
  EXPECT_GT(floor_share_of_table(-0.2), 0.2) << "that of another room";
}

/// How far back a settee is found whose near arm stands apart from its back, as a low camera sees
/// it: a chest hides the foot of the back, which is so far away and seen from so high on.
double depth_of_settee_m(double back_m, double back_from_m) {
  BoxScene scene = room();
  scene.add(kChair, {1.0, 0.15, 0}, {1.3, 0.55, 0.7});
  const double scale = back_m / 1.9;  // it looks the same from the camera
  scene.add(kChair,
            {back_m, -0.8 * scale, 0.5 + scale * (back_from_m - 0.5)},
            {back_m + 0.1, 0.5 * scale, 0.5 + scale * 0.35});
  scene.add(kCupboard, {1.5, -0.7, 0}, {1.6, 0.1, 0.4});
  const SceneView view = scene.view(test::look_at({0, 0, 0.5}, {2, 0, 0.5}), 1);
  const auto found = segment(view.frame, detection_of(view, kChair), {});
  EXPECT_TRUE(found.has_value());
  return found ? found->box.extent().x() : 0.0;
}

TEST(SurfaceChoice, HasTheFarSideThatEndsTheBox) {
  EXPECT_NEAR(depth_of_settee_m(1.9, 0.3), 0.9, 0.03);
  EXPECT_NEAR(depth_of_settee_m(3.4, 0.3), 2.4, 0.05);
  EXPECT_LT(depth_of_settee_m(3.6, 0.3), 0.6) << "nothing that stands in a room is 2.6 m deep";
  EXPECT_LT(depth_of_settee_m(1.9, 0.75), 0.6) << "a board on the wall is too low for a side";
}

/// How high a bed is found, so wide and seen from its foot, whose mattress and cushions end so far
/// away and whose head ends there; so far behind the head is a wall.
double height_of_long_bed_m(double cushions_end_m,
                            double head_end_m,
                            double wall_gap_m,
                            double width_m = 0.94) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {8, 4, 0});
  scene.add(kWall, {head_end_m + wall_gap_m, -4, 0}, {8, 4, 3});
  const double side_m = width_m / 2;
  const double slim_m = side_m - 0.07;
  scene.add(kChair, {2.6, -side_m, 0}, {cushions_end_m - 0.1, side_m, 0.5});
  scene.add(kChair, {cushions_end_m - 0.1, -slim_m, 0.3}, {cushions_end_m, slim_m, 0.62});
  scene.add(kChair, {head_end_m - 0.05, -side_m, 0}, {head_end_m, side_m, 1.0});
  const SceneView view = scene.view(test::look_at({0, 0, 1.3}, {3.5, 0, 0.4}), 1);
  const auto found = segment(view.frame, detection_of(view, kChair), {});
  EXPECT_TRUE(found.has_value());
  return found ? found->box.max_in_map.z() : 0.0;
}

TEST(SurfaceChoice, HasTheHeadToWhichALongBedLeads) {
  EXPECT_GT(height_of_long_bed_m(4.4, 4.7, 0.6), 0.95);
  EXPECT_GT(height_of_long_bed_m(4.4, 4.7, 0.05), 0.95) << "a wall: hardly an outline";
  EXPECT_LT(height_of_long_bed_m(3.6, 4.7, 0.6), 0.7) << "a chair, and what is behind it";
  EXPECT_LT(height_of_long_bed_m(3.4, 3.6, 0.6, 0.45), 0.7) << "so deep a chair is none";
  EXPECT_LT(height_of_long_bed_m(4.9, 5.3, 0.6), 0.7) << "nothing in a room is 2.7 m deep";
}

/// Share of the pixels of a board, half under the top of a table at that height, in what is found
/// of the table, whose box is the one around both.
double board_share_of_table(double height_m) {
  BoxScene scene = room();
  scene.add(kTable, {1.6, -0.5, 0.7}, {2.2, 0.5, 0.72});
  scene.add(kChair, {1.3, -0.2, height_m - 0.04}, {1.7, 0.2, height_m});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {1.8, 0, 0.5}), 1);
  Detection table = detection_of(view, kTable);
  table.box_px.v_max_px = detection_of(view, kChair).box_px.v_max_px;
  const auto found = segment(view.frame, table, {});
  if (!found) return -1.0;
  const auto truth = view.truth.pixels();
  const auto num_found = std::count_if(found->pixel_indices.begin(),
                                       found->pixel_indices.end(),
                                       [&](std::uint32_t pixel) { return truth[pixel] == kChair; });
  return static_cast<double>(num_found) /
         static_cast<double>(std::count(truth.begin(), truth.end(), kChair));
}

TEST(SurfaceChoice, LacksASeatUnderATable) {
  EXPECT_EQ(board_share_of_table(0.46), 0.0);
  EXPECT_EQ(board_share_of_table(0.55), 0.0);
  EXPECT_GT(board_share_of_table(0.65), 0.8) << "so near below the top it may be of the table";
}

TEST(SurfaceChoice, HasTheRailAboveASeat) {
  // A rail of 5 cm is as wide as the seat, and from above as narrow as a level face is low.
  BoxScene scene = room();
  scene.add(kChair, {2.0, -0.2, 0.42}, {2.4, 0.24, 0.46});
  scene.add(kChair, {2.2, 0.0, 0}, {2.24, 0.04, 0.42});
  scene.add(kChair, {2.38, -0.2, 0.75}, {2.4, 0.24, 0.8});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2.2, 0, 0.5}), 1);
  const auto found = segment(view.frame, detection_of(view, kChair), {});
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(found->box.max_in_map.z(), 0.78);
}

}  // namespace
}  // namespace hypermap
