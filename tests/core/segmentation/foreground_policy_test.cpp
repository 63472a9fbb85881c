// SPDX-License-Identifier: BSD-3-Clause
#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace hypermap {
namespace {

using test::BoxScene;
using test::detection_of;
using test::kChair;
using test::kCup;
using test::kCupboard;
using test::kFloor;
using test::kKeyboard;
using test::kMouse;
using test::kScreen;
using test::kTable;
using test::kWall;
using test::office;
using test::office_view;
using test::OfficeObject;
using test::SceneView;

struct Expected {
  OfficeObject object;
  double least_overlap;
};

class Foreground : public testing::TestWithParam<Expected> {};

TEST_P(Foreground, FindsTheThingAndNotWhatCarriesIt) {
  for (unsigned seed = 1; seed <= test::repetitions(3U); ++seed) {
    const SceneView view = office_view(seed);
    const auto found = segment(view.frame, detection_of(view, GetParam().object), {});
    ASSERT_TRUE(found.has_value()) << to_string(found.error());
    EXPECT_GE(test::pixel_overlap(found->pixel_indices, view.truth, GetParam().object),
              GetParam().least_overlap);
    const Box truth = office().box_of(GetParam().object);
    EXPECT_TRUE((found->box.min_in_map.array() > truth.min_in_map.array() - 0.03).all());
    EXPECT_TRUE((found->box.max_in_map.array() < truth.max_in_map.array() + 0.03).all());
  }
}

INSTANTIATE_TEST_SUITE_P(Office,
                         Foreground,
                         testing::Values(Expected{kScreen, 0.95},
                                         Expected{kKeyboard, 0.85},
                                         Expected{kMouse, 0.6},
                                         Expected{kCup, 0.85},
                                         Expected{kChair, 0.85},
                                         Expected{kCupboard, 0.7} /* a sliver at the edge */));

TEST(ForegroundPlanes, ThatCutASurfaceTakeNothingOfIt) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {5, -4, 0}, {5.1, 4, 3});
  scene.add(kTable, {1.7, -1.6, 0.72}, {2.6, -0.35, 0.75});  // tops that go on beside the board
  scene.add(kTable, {1.7, 0.35, 0.72}, {2.6, 1.6, 0.75});
  scene.add(kChair, {2.0, -0.25, 0.0}, {2.05, 0.25, 1.0});
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const SceneView view = scene.view(test::look_at({0, 0, 1.4}, {2.0, 0, 0.7}), seed);
    const auto found = segment(view.frame, detection_of(view, kChair), {});
    ASSERT_TRUE(found.has_value()) << to_string(found.error());
    EXPECT_GE(test::pixel_overlap(found->pixel_indices, view.truth, kChair), 0.97);
  }
}

/// What is found of a chair that is pushed under a desk with a keyboard on it, from beyond the
/// desk, from that height: its back is seen above the top, its legs below.
Result<Segment> found_beyond_a_desk(double camera_height_m) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {5, -4, 0}, {5.1, 4, 3});
  scene.add(kTable, {1.7, -1.2, 0.66}, {2.4, 1.2, 0.72});
  scene.add(kTable, {1.72, 1.1, 0}, {1.78, 1.16, 0.66});
  scene.add(kKeyboard, {2.1, 0.7, 0.72}, {2.3, 1.0, 0.75});
  scene.add(kChair, {2.6, 0.55, 0.42}, {2.65, 1.05, 1.0});
  scene.add(kChair, {2.2, 0.55, 0.42}, {2.65, 1.05, 0.46});
  scene.add(kChair, {2.2, 0.55, 0}, {2.25, 0.6, 0.42})
      .add(kChair, {2.2, 1.0, 0}, {2.25, 1.05, 0.42});
  const SceneView view =
      scene.view(test::look_at({0.3, -1.0, camera_height_m}, {2.3, 0.8, 0.6}), 1);
  return segment(view.frame, detection_of(view, kChair), {});
}

TEST(ForegroundChair, LacksTheRimOfTheDeskBeforeIt) {
  const auto found = found_beyond_a_desk(1.5);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GT(found->box.min_in_map.x(), 2.15) << "the rim is at 1.7";
  EXPECT_GT(found->box.max_in_map.z(), 0.95);
}

TEST(ForegroundChair, LacksWhatLiesOnTheDeskBeforeIt) {
  const auto found = found_beyond_a_desk(1.2);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GT(found->box.min_in_map.x(), 2.15) << "the keyboard begins at 2.1";
}

/// How low a cupboard reaches that is seen over a table and, between the boards below its top,
/// under it. Before it stands, as deep, what the table hides on all sides but the lowest.
double foot_beyond_a_table_m(double depth_m) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {5, -4, 0}, {5.1, 4, 3});
  scene.add(kTable, {1.5, -1.2, 0.7}, {2.3, 1.2, 0.75});
  scene.add(kTable, {2.25, -1.2, 0}, {2.3, -0.18, 0.7});
  scene.add(kTable, {2.25, 0.18, 0}, {2.3, 1.2, 0.7});
  scene.add(kCupboard, {3.2, -0.3, 0}, {3.8, 0.3, 1.6});
  scene.add(kCupboard, {3.2 - depth_m, -0.3, 0}, {3.2, 0.3, 0.3});
  const SceneView view = scene.view(test::look_at({0, 0, 0.95}, {3.2, 0, 0.7}), 1);
  const auto found = segment(view.frame, detection_of(view, kCupboard), {});
  return found ? found->box.min_in_map.z() : 0.0;
}

TEST(ForegroundPart, ThatSomethingHidesAllAroundStandsUnderTheRest) {
  EXPECT_LT(foot_beyond_a_table_m(0.02), 0.1);
  EXPECT_GT(foot_beyond_a_table_m(0.12), 0.6) << "a thing that touches it";
  EXPECT_GT(foot_beyond_a_table_m(0.5), 0.6) << "a thing beside it";
}

/// How wide a cupboard of 1.2 m is found behind a post of this width that parts it in the picture;
/// of what is to the right of the post everything is so much farther back.
double width_behind_a_post_m(double post_m, double back_m) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {5, -4, 0}, {5.1, 4, 3});
  scene.add(kCup, {1.5, -post_m / 2, 0}, {1.7, post_m / 2, 2});
  scene.add(kCupboard, {3.0, 0, 0}, {3.5, 0.7, 1.2});
  scene.add(kCupboard, {3.0 + back_m, -0.5, 0}, {3.5 + back_m, 0, 1.2});
  const SceneView view = scene.view(test::look_at({0, 0, 1}, {3, 0, 0.7}), 1);
  const auto found = segment(view.frame, detection_of(view, kCupboard), {});
  return found ? found->box.extent().y() : 0.0;
}

TEST(ForegroundPart, BesideTheRestBehindSomethingNearer) {
  EXPECT_NEAR(width_behind_a_post_m(0.2, 0.0), 1.2, 0.03);
  EXPECT_LT(width_behind_a_post_m(0.2, 0.4), 0.6) << "another thing";
  EXPECT_LT(width_behind_a_post_m(0.3, 0.0), 0.6) << "0.6 m apart, they may be two";
}

/// How high a bed of 2.1 m is found whose head is seen over its cushions; the head stands so much
/// farther back and is so wide and high: over 1 m the picture cuts it, and the box begins below.
double height_of_bed_m(double back_m, double width_m, double height_m = 1.0) {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {4.8, -4, 0}, {4.9, 4, 3});
  scene.add(kCupboard, {1.4, -0.7, 0}, {3.0, 0.7, 0.5});
  scene.add(kCupboard, {3.0, -0.6, 0.3}, {3.2, 0.6, 0.62});
  scene.add(kCupboard, {3.45 + back_m, -width_m / 2, 0}, {3.5 + back_m, width_m / 2, height_m});
  const SceneView view = scene.view(test::look_at({0, 0, 1.1}, {2.4, 0, 0.3}), 1);
  Detection bed = detection_of(view, kCupboard);
  if (height_m > 1.0) bed.box_px.v_min_px = 20.0;
  const auto found = segment(view.frame, bed, {});
  return found ? found->box.max_in_map.z() : 0.0;
}

TEST(ForegroundPart, ThatEndsTheBoxAtTheTopIsItsOwn) {
  EXPECT_GT(height_of_bed_m(0.0, 1.4), 0.95);
  EXPECT_LT(height_of_bed_m(1.2, 2.0), 0.7) << "deeper than beds are";
  EXPECT_LT(height_of_bed_m(0.0, 0.3), 0.7) << "a narrow thing that looks over it";
  EXPECT_LT(height_of_bed_m(0.0, 1.4, 3.0), 0.7) << "a wall that the picture cuts";
}

/// A bench without a back in a hall that is deeper than depth counts, before a camera this high.
/// Its detection lacks a share of it on the right.
double overlap_of_bench(double camera_height_m, double missing_share) {
  BoxScene scene;
  scene.add(kFloor, {-1, -9, -0.1}, {12, 9, 0}).add(kWall, {12, -9, 0}, {12.1, 9, 3});
  scene.add(kTable, {1.5, -0.5, 0.4}, {1.85, 0.5, 0.45});
  for (const double y : {-0.4, 0.36}) scene.add(kTable, {1.6, y, 0}, {1.75, y + 0.04, 0.4});
  const SceneView view = scene.view(test::look_at({0, 0, camera_height_m}, {1.7, 0, 0.3}), 1);
  Detection bench = detection_of(view, kTable);
  bench.box_px.u_max_px -= missing_share * (bench.box_px.u_max_px - bench.box_px.u_min_px);
  const auto found = segment(view.frame, bench, {});
  return found ? test::pixel_overlap(found->pixel_indices, view.truth, kTable) : 0.0;
}

TEST(ForegroundBench, IsNoRimThoughItsDetectionIsTooNarrow) {
  for (const double camera_height_m : {0.45, 0.6, 0.7, 0.8}) {
    EXPECT_GT(overlap_of_bench(camera_height_m, 0.1), 0.5) << camera_height_m;
    EXPECT_GT(overlap_of_bench(camera_height_m, 0.2), 0.4) << camera_height_m;
  }
}

TEST(ForegroundPoints, AreFineOnSmallThingsAndBoundedOnLargeOnes) {
  const SceneView view = office_view(4);
  EXPECT_GE(segment(view.frame, detection_of(view, kMouse), {})->points_in_map.size(), 100U);
  EXPECT_LE(segment(view.frame, detection_of(view, kCupboard), {})->points_in_map.size(), 2000U);
}

TEST(ForegroundTable, IsTheTableWhenTheTableIsAskedFor) {
  BoxScene scene;
  scene.add(kFloor, {-4, -4, -0.1}, {4, 4, 0}).add(kTable, {1.5, -0.6, 0.72}, {2.3, 0.6, 0.75});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2, 0, 0.7}), 1);
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  EXPECT_GE(test::pixel_overlap(found->pixel_indices, view.truth, kTable), 0.9);
}

/// A table seen from the height of its top: of that the near edge alone is measured.
BoxScene flat_table(double far_legs_x) {
  BoxScene scene;
  scene.add(kFloor, {-4, -4, -0.1}, {8, 4, 0}).add(kWall, {4.6, -4, 0}, {4.7, 4, 3});
  scene.add(kTable, {2.0, -0.7, 0.72}, {2.05, 0.7, 0.76});
  for (const double x : {2.0, far_legs_x}) {
    scene.add(kTable, {x, -0.7, 0}, {x + 0.06, -0.64, 0.72});
    scene.add(kTable, {x, 0.64, 0}, {x + 0.06, 0.7, 0.72});
  }
  return scene;
}

double found_depth_m(const BoxScene& scene) {
  const SceneView view = scene.view(test::look_at({0, 0, 0.74}, {2, 0, 0.5}), 1);
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  return found ? found->box.extent().x() : 0.0;
}

TEST(ForegroundTable, HasItsFarLegsThoughItsTopIsNotMeasured) {
  EXPECT_NEAR(found_depth_m(flat_table(2.8)), 0.86, 0.02);
}

TEST(ForegroundTable, EndsWhereSomethingStandsFartherBehindThanTablesAreDeep) {
  EXPECT_LT(found_depth_m(flat_table(4.2)), 0.1);
}

TEST(ForegroundTable, LacksWhatStandsBehindItThoughItIsInTheBox) {
  BoxScene scene = flat_table(2.74);
  scene.add(kTable, {2.0, -0.7, 0.72}, {2.8, 0.7, 0.76});
  scene.add(kChair, {3.1, -0.1, 0.4}, {3.2, 0.1, 1.0});
  const SceneView view = scene.view(test::look_at({0, 0, 1.4}, {2.4, 0, 0.7}), 1);
  Detection table = detection_of(view, kTable);
  table.box_px.v_min_px = test::tight_box(view.truth, kChair)->v_min_px;
  const auto found = segment(view.frame, table, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->box.max_in_map.x(), 2.8, 0.05);
}

/// A bed seen from its foot. At its head, in its box and 2 cm beside it, there is something of this
/// edge up to this height; how far to that side the bed reaches, from its middle.
double side_of_bed_m(double edge_m, double top_m) {
  BoxScene scene;
  scene.add(kFloor, {0.5, -3, -0.1}, {6, 3, 0}).add(kTable, {1.5, -0.8, 0.2}, {3.5, 0.8, 0.5});
  scene.add(kTable, {3.5, -0.8, 0}, {3.55, 0.8, 0.95});
  scene.add(kChair, {3.4 - edge_m, 0.82, top_m - edge_m}, {3.4, 0.82 + edge_m, top_m});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2.5, 0, 0.5}), 1);
  const auto found = segment(view.frame, detection_of(view, kTable), {});
  return found ? found->box.max_in_map.y() : 0.0;
}

TEST(ForegroundBed, LacksWhatStandsBesideItThoughItIsInTheBox) {
  EXPECT_NEAR(side_of_bed_m(0.4, 0.42), 0.8, 0.03);
}

TEST(ForegroundBed, HasAFragmentBesideIt) {
  EXPECT_NEAR(side_of_bed_m(0.15, 0.62), 0.97, 0.03);
}

TEST(ForegroundFlatThing, IsThePatchOfItsSupportInsideTheBox) {
  BoxScene scene;
  scene.add(kTable, {0.5, -2, 0.7}, {4, 2, 0.75});
  const SceneView view = scene.view(test::look_at({0, 0, 1.5}, {2, 0, 0.75}));
  Detection sheet;
  sheet.box_px = {300, 220, 340, 260};
  const auto found = segment(view.frame, sheet, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->pixel_indices.size(), 40U * 40U);
}

/// A box in which a mouse lies on a floor; of its upper rows so many are without depth.
Result<Segment> found_beside_a_hole(int hole_px) {
  BoxScene scene;
  scene.add(kFloor, {1.5, -2, -1}, {4, 2, 0.5}).add(kMouse, {1.6, -0.05, 0.5}, {1.65, 0.05, 0.58});
  SceneView view = scene.view(test::look_at({0, 0, 1.0}, {1.6, 0, 0.56}));
  Detection cup;
  cup.box_px = {280, 180, 360, 275};
  for (int v = 180; v < 180 + hole_px; ++v) {
    for (int u = 280; u < 360; ++u) view.frame.depth_m.at(u, v) = 0.0F;
  }
  return segment(view.frame, cup, {});
}

TEST(ForegroundHole, WhatIsBesideTheUnmeasuredIsNotTheThing) {
  EXPECT_TRUE(found_beside_a_hole(0).has_value());
  EXPECT_FALSE(found_beside_a_hole(45).has_value());
}

TEST(ForegroundMask, ReplacesTheBox) {
  const SceneView view = office_view(5);
  Detection masked = detection_of(view, kCup);
  masked.box_px = {0, 0, 640, 480};
  masked.mask = MaskImage(640, 480);
  for (std::size_t i = 0; i < view.truth.size(); ++i) {
    masked.mask->pixels()[i] = view.truth.pixels()[i] == kCup ? 1 : 0;
  }
  const auto found = segment(view.frame, masked, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(test::pixel_overlap(found->pixel_indices, view.truth, kCup), 0.95);
}

}  // namespace
}  // namespace hypermap
