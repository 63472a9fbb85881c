// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"

#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr Rgb8 kRed{200, 30, 30};
constexpr Rgb8 kBlue{30, 30, 200};

/// A layer that draws what it is told to.
class Sketch final : public MapLayer {
 public:
  explicit Sketch(std::vector<LayerPrimitive> primitives) : primitives_(std::move(primitives)) {}

  [[nodiscard]] std::string_view class_name() const override { return "Sketch"; }
  [[nodiscard]] LayerStatistics statistics() const override { return {}; }
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery&) const override {
    return std::vector<LayerAnswer>{};
  }
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override { return primitives_; }
  [[nodiscard]] Result<void> save(LayerWriter&) const override { return {}; }
  [[nodiscard]] bool equals(const MapLayer& other) const override { return this == &other; }

 private:
  std::vector<LayerPrimitive> primitives_;
};

Layer sketch(std::vector<LayerPrimitive> primitives) {
  return {.info = {.name = "sketch", .frame_id = "lab"}, .content = Sketch(std::move(primitives))};
}

DrawnArea square(double x) {
  return {.parts = {make_polygon({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}).value()},
          .class_name = "sink",
          .id = static_cast<std::uint64_t>(x)};
}

/// Two cells side by side, the left one red, the right one blue.
DrawnCells two_cells() {
  return {.geometry = {.resolution_m = 1.0, .cols = 2, .rows = 1}, .colors = {kRed, kBlue}};
}

TEST(LayerScene, EachPrimitiveComesToThoseOfItsKind) {
  SnapshotScene scene{.frame_id = "lab"};
  const ClassId chair = scene.classes.add("chair").value();
  scene = with_layer(std::move(scene),
                     sketch({square(0),
                             square(2),
                             DrawnOccupancy{},
                             two_cells(),
                             DrawnLine{.points = {{0, 0}, {1, 1}}, .color = kRed},
                             DrawnText{.position = {1, 1}, .text = "here", .color = kRed},
                             DrawnBox{.box = {}, .class_name = "chair", .id = 7},
                             DrawnVoxels{[](const LeafVisitor&) {}}}),
                     {});
  EXPECT_EQ(scene.frame_id, "lab");
  EXPECT_EQ(scene.semantic.size(), 2U);
  EXPECT_TRUE(scene.occupancy);
  EXPECT_EQ(scene.overlay.cells.size(), 1U);
  EXPECT_EQ(scene.overlay.lines.size(), 1U);
  EXPECT_EQ(scene.overlay.texts.size(), 1U);
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].class_id, chair);
  EXPECT_EQ(scene.objects[0].label, "chair 7");
  EXPECT_EQ(scene.semantic[1].id, 2U);
  EXPECT_TRUE(scene.leaves);
}

TEST(LayerScene, AreasOfOneLayerAreShownAndOverlaysOfAll) {
  const SnapshotScene first = with_layer({.frame_id = "lab"}, sketch({square(0), two_cells()}), {});
  const SnapshotScene both = with_layer(first, sketch({square(2), square(4), two_cells()}), {});
  EXPECT_EQ(both.semantic, first.semantic);
  EXPECT_EQ(both.overlay.cells.size(), 2U);
}

TEST(LayerScene, EachPrimitiveIsBroughtIntoTheScenesFrame) {
  // x of the laboratory is y of the map, its origin at (10, 20): (1, 0) there is (10, 21) here.
  FrameTree frames;
  ASSERT_TRUE(frames.add({.frame_id = "map",
                          .child_frame_id = "lab",
                          .x_m = 10.0,
                          .y_m = 20.0,
                          .yaw_rad = std::numbers::pi / 2}));
  const LeafSource one = [](const LeafVisitor& visit) {
    visit(LeafSample{.centre_in_map = {1, 0, 3}, .edge_m = 0.1});
  };
  const OccupancyGrid grid =
      OccupancyGrid::create({.resolution_m = 1.0, .origin = {1, 0}, .cols = 2, .rows = 1}).value();
  const SnapshotScene scene =
      with_layer({},
                 sketch({square(1),
                         DrawnOccupancy{grid},
                         two_cells(),
                         DrawnLine{.points = {{1, 0}}, .color = kRed},
                         DrawnText{.position = {1, 0}, .text = "here", .color = kRed},
                         DrawnBox{.box = {{1, 0, 0}, {3, 1, 1}}, .class_name = "chair"},
                         DrawnVoxels{one}}),
                 frames);
  EXPECT_TRUE(scene.left_out.empty());
  const Eigen::Vector2d here(10, 21);
  EXPECT_TRUE(scene.semantic.at(0).parts.at(0).outer.at(0).isApprox(here));
  EXPECT_TRUE(scene.occupancy->geometry().origin.isApprox(here));
  EXPECT_NEAR(scene.occupancy->geometry().yaw_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_TRUE(scene.overlay.cells.at(0).geometry.origin.isApprox(Eigen::Vector2d(10, 20)));
  EXPECT_TRUE(scene.overlay.lines.at(0).points.at(0).isApprox(here));
  EXPECT_TRUE(scene.overlay.texts.at(0).position.isApprox(here));
  EXPECT_TRUE(scene.objects.at(0).box.min_in_map.isApprox(Eigen::Vector3d(9, 21, 0)));
  EXPECT_TRUE(scene.objects.at(0).box.max_in_map.isApprox(Eigen::Vector3d(10, 23, 1)));
  scene.leaves([](const LeafSample& leaf) {
    EXPECT_TRUE(leaf.centre_in_map.isApprox(Eigen::Vector3d(10, 21, 3)));
  });
}

TEST(LayerScene, ALayerOfAFrameThatNothingConnectsIsLeftOut) {
  const SnapshotScene scene = with_layer({}, sketch({square(0), two_cells()}), {});
  EXPECT_TRUE(scene.semantic.empty());
  EXPECT_TRUE(scene.overlay.empty());
  EXPECT_EQ(scene.left_out, std::vector<std::string>{"layer sketch: nothing connects lab and map"});
}

TEST(LayerScene, CellsHaveTheirColorsFromAbove) {
  if (const auto context = EglContext::create(); !context)
    GTEST_SKIP() << to_string(context.error());
  const auto image =
      render_snapshot(with_layer({.frame_id = "lab"}, sketch({two_cells()}), {}),
                      {.view = TopView{}, .width_px = 200, .height_px = 100, .annotations = false});
  ASSERT_TRUE(image) << to_string(image.error());
  const auto is_near = [](Rgb8 a, Rgb8 b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 12;
  };
  EXPECT_TRUE(is_near(image->at(70, 30), kRed));
  EXPECT_TRUE(is_near(image->at(130, 30), kBlue));
}

}  // namespace
}  // namespace hypermap
