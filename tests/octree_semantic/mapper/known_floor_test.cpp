// SPDX-License-Identifier: BSD-3-Clause
// The floor that earlier frames showed is no part of what stands on it.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "support/box_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hypermap {
namespace {

enum Solid { kFloor = 1, kTable };

test::BoxScene floor_alone() {
  test::BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {1.4, 4, 0});
  return scene;
}

/// A table without a top that fills the picture of a low camera.
RgbdFrame frame_of_table() {
  test::BoxScene scene = floor_alone();
  for (const double y : {-0.365, 0.325}) {
    scene.add(kTable, {0.6, y, 0}, {0.64, y + 0.04, 0.75});
    scene.add(kTable, {1.2, y, 0}, {1.24, y + 0.04, 0.75});
  }
  scene.add(kTable, {1.2, -0.365, 0.65}, {1.24, 0.365, 0.75});
  test::SceneView view = scene.view(test::look_at({0, 0, 0.45}, {1.5, 0, 0.4}), 1);
  view.frame.index = 1;
  view.frame.detections = {{.box_px = test::tight_box(view.truth, kTable).value(),
                            .class_scores = {{ClassId{0}, Probability(1.0)}},
                            .score = Probability(0.9),
                            .detector = {},
                            .mask = {}}};
  return view.frame;
}

/// Cells of the table's points between its front and its back legs, on the floor.
long floor_cells_of_table(SemanticMapper& mapper, const RgbdFrame& frame) {
  EXPECT_TRUE(mapper.integrate(frame));
  EXPECT_EQ(mapper.objects().size(), 1U);
  const auto state = mapper.objects().objects().begin()->points.state();
  return std::ranges::count_if(state.votes, [&](const auto& vote) {
    const double x_m = state.edge_m * vote.cell.x;
    return x_m > 0.7 && x_m < 1.1 && state.edge_m * vote.cell.z < 0.03;
  });
}

SemanticMapper new_mapper() {
  ClassRegistry classes;
  EXPECT_TRUE(classes.add("diningtable"));
  return SemanticMapper::create({}, classes).value();
}

TEST(KnownFloor, OfAnEarlierFrameIsNoPartOfATableThatFillsThePicture) {
  SemanticMapper informed = new_mapper();
  const RgbdFrame before = floor_alone().view(test::look_at({0, 0, 0.9}, {1, 0, 0}), 1).frame;
  ASSERT_TRUE(informed.integrate(before));
  EXPECT_EQ(floor_cells_of_table(informed, frame_of_table()), 0);
  SemanticMapper uninformed = new_mapper();
  EXPECT_GT(floor_cells_of_table(uninformed, frame_of_table()), 20) << "it may be a bed's top";
}

TEST(KnownFloor, MayBeStatedByWhoGivesTheFrame) {
  SemanticMapper mapper = new_mapper();
  RgbdFrame frame = frame_of_table();
  frame.floor_height_m = 0.0;
  EXPECT_EQ(floor_cells_of_table(mapper, frame), 0);
}

}  // namespace
}  // namespace hypermap
