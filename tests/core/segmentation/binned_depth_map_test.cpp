// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/binned_depth_map.hpp"

#include "support/box_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

/// 48 x 32 pixels, so that 24 x 16 panels have 2 x 2 pixels each; the map is the camera.
RgbdFrame small_frame(float depth_m) {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 48, .height_px = 32, .fx_px = 10, .fy_px = 10, .cx_px = 0, .cy_px = 0};
  frame.depth_m = DepthImage(48, 32, depth_m);
  return frame;
}

// [smap] 3.4, table D.2. Panel (1, 2) holds columns 2, 3 and rows 4, 5. At 2 m, x = u / 10 * 2:
// 0.4 to 0.6; y = v / 10 * 2: 0.8 to 1.0.
TEST(BinnedDepthMap, BoxesThePointsOfEachPanel) {
  const BinnedDepthMap map = BinnedDepthMap::create(small_frame(2.0F));
  EXPECT_EQ(map.columns(), 24);
  EXPECT_EQ(map.rows(), 16);
  const DepthPanel& panel = map.at(1, 2);
  EXPECT_EQ(panel.num_points, 4U);
  EXPECT_TRUE(panel.box.min_in_map.isApprox(Eigen::Vector3d(0.4, 0.8, 2.0)));
  EXPECT_TRUE(panel.box.max_in_map.isApprox(Eigen::Vector3d(0.6, 1.0, 2.0)));
  EXPECT_NEAR(panel.nearest_m, Eigen::Vector3d(0.4, 0.8, 2.0).norm(), 1e-12);
  EXPECT_NEAR(panel.farthest_m, Eigen::Vector3d(0.6, 1.0, 2.0).norm(), 1e-12);
}

TEST(BinnedDepthMap, SkipsWhatIsNoMeasurementOrOutOfRange) {
  RgbdFrame frame = small_frame(0.0F);
  EXPECT_EQ(BinnedDepthMap::create(frame).at(0, 0).num_points, 0U);
  frame.depth_m.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  frame.depth_m.at(1, 0) = std::numeric_limits<float>::infinity();
  frame.depth_m.at(0, 1) = 5.1F;
  frame.depth_m.at(1, 1) = 0.1F;
  EXPECT_EQ(BinnedDepthMap::create(frame).at(0, 0).num_points, 0U);
  frame.depth_m.at(1, 1) = 5.0F;
  EXPECT_EQ(BinnedDepthMap::create(frame).at(0, 0).num_points, 1U);
}

TEST(BinnedDepthMap, CountsEachPixelOnceWhenPanelsDoNotDivideTheImage) {
  RgbdFrame frame = small_frame(1.0F);
  for (const auto& [columns, rows] : {std::pair{7, 5}, {48, 32}, {100, 64}, {1, 1}}) {
    const BinnedDepthMap map = BinnedDepthMap::create(frame, {.columns = columns, .rows = rows});
    std::uint32_t sum = 0;
    for (const DepthPanel& panel : map.panels()) sum += panel.num_points;
    EXPECT_EQ(sum, 48U * 32U);
  }
}

TEST(BinnedDepthMap, PanelsLieInTheImageAsTheyAreNumbered) {
  RgbdFrame frame = small_frame(2.0F);
  frame.map_from_camera = MapFromCamera(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)));
  for (const int columns : {24, 7, 48}) {
    const BinnedDepthMap map = BinnedDepthMap::create(frame, {.columns = columns, .rows = 5});
    EXPECT_EQ(map.camera_centre().xyz, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(map.camera_axis_in_map(), Eigen::Vector3d::UnitZ());
    for (int column = 1; column < columns; ++column) {
      EXPECT_LT(map.at(column - 1, 2).box.max_in_map.x(), map.at(column, 2).box.min_in_map.x());
    }
    for (int row = 1; row < 5; ++row) {
      EXPECT_LT(map.at(3, row - 1).box.max_in_map.y(), map.at(3, row).box.min_in_map.y());
    }
  }
}

TEST(BinnedDepthMap, IsTheSameWithAnyNumberOfThreads) {
  test::BoxScene scene;
  scene.add(1, {2, -2, 0}, {3, 2, 2});
  const RgbdFrame frame = scene.view(test::look_at({0, 0, 1}, {2, 0, 1}), 3).frame;
  const BinnedDepthMap one = BinnedDepthMap::create(frame, {}, 1);
  const BinnedDepthMap four = BinnedDepthMap::create(frame, {}, 4);
  for (std::size_t i = 0; i < one.panels().size(); ++i) {
    EXPECT_EQ(one.panels()[i].box, four.panels()[i].box);
  }
}

TEST(BinnedDepthMapRules, NameTheBrokenField) {
  EXPECT_EQ(validate(BinnedDepthMapOptions{.columns = 0}).error().field, "columns");
  EXPECT_EQ(validate(BinnedDepthMapOptions{.rows = 4097}).error().field, "rows");
  EXPECT_EQ(validate(BinnedDepthMapOptions{.min_range_m = -1}).error().field, "min_range_m");
  EXPECT_EQ(validate(BinnedDepthMapOptions{.max_range_m = 0.2}).error().field, "max_range_m");
}

}  // namespace
}  // namespace hypermap
