// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include "core/segmentation/office_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hypermap {
namespace {

using test::BoxScene;
using test::detection_of;
using test::kCup;
using test::kKeyboard;
using test::kMouse;
using test::kScreen;
using test::office_view;
using test::SceneView;

/// A plate of 11 x 11 pixels, 1 cm apart, 1 m before the camera, whose frame is the map's.
RgbdFrame plate() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 20, .height_px = 20, .fx_px = 100, .fy_px = 100, .cx_px = 0, .cy_px = 0};
  frame.depth_m = DepthImage(20, 20);
  for (int v = 0; v < 11; ++v) {
    for (int u = 0; u < 11; ++u) frame.depth_m.at(u, v) = 1.0F;
  }
  return frame;
}

Detection whole_image() {
  Detection detection;
  detection.box_px = {0, 0, 20, 20};
  return detection;
}

GeometricSegmentationOptions smap_for_small_clouds() {
  GeometricSegmentationOptions options = smap_segmentation();
  options.outlier_neighbours = 0;
  options.cluster_min_points = 1;
  return options;
}

// [smap] Eq. (3.6), Eq. (3.7): the crop [1..3) x [2..6) of the image has 2 x 4 pixels.
TEST(ClusterPolicy, CropsToTheBox) {
  GeometricSegmentationOptions options = smap_for_small_clouds();
  options.leaf_size_m = 0.0;
  Detection detection;
  detection.box_px = {1, 2, 3, 6};
  const auto found = segment(plate(), detection, options);
  EXPECT_EQ(found->pixel_indices, (std::vector<std::uint32_t>{41, 42, 61, 62, 81, 82, 101, 102}));
  // [smap] pseudocode 3.2: x = 0.01 to 0.02, y = 0.02 to 0.05.
  EXPECT_TRUE(found->box.min_in_map.isApprox(Eigen::Vector3d(0.01, 0.02, 1.0), 1e-6));
  EXPECT_TRUE(found->box.max_in_map.isApprox(Eigen::Vector3d(0.02, 0.05, 1.0), 1e-6));
  EXPECT_TRUE(found->centroid_in_map.isApprox(Eigen::Vector3d(0.015, 0.035, 1.0), 1e-6));
  EXPECT_NEAR(found->distance_m, Eigen::Vector3d(0.015, 0.035, 1.0).norm(), 1e-6);
}

// [smap] Eq. (3.8): floor(p / S_leaf) with S_leaf = 0.035: 0 to 3 cm in the first voxel, 4 to 6 in
// the second, 7 to 10 in the third, on both axes: 9 voxels; the first one's mean is 1.5 cm.
TEST(ClusterPolicy, ThinsByAVoxelGrid) {
  GeometricSegmentationOptions options = smap_for_small_clouds();
  options.leaf_size_m = 0.035;
  const auto found = segment(plate(), whole_image(), options);
  ASSERT_EQ(found->points_in_map.size(), 9U);
  EXPECT_TRUE(found->points_in_map[0].isApprox(Eigen::Vector3f(0.015F, 0.015F, 1.0F), 1e-5F));
  EXPECT_EQ(found->pixel_indices.size(), 121U);
}

// [smap] Eq. (3.9): P_world = T P_sensor; turned by 90 degrees about z and lifted by 1 m,
// (0.01, 0.02, 1) becomes (-0.02, 0.01, 2).
TEST(ClusterPolicy, BoxesInTheMapFrame) {
  RgbdFrame frame = plate();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.translation().z() = 1.0;
  frame.map_from_camera = MapFromCamera(pose);
  GeometricSegmentationOptions options = smap_for_small_clouds();
  options.leaf_size_m = 0.0;
  Detection detection;
  detection.box_px = {1, 2, 2, 3};
  EXPECT_TRUE(segment(frame, detection, options)
                  ->box.centre()
                  .isApprox(Eigen::Vector3d(-0.02, 0.01, 2.0), 1e-6));
}

TEST(ClusterPolicy, KeepsTheLargestOfTwoClusters) {
  RgbdFrame frame = plate();
  for (int v = 0; v < 11; ++v) frame.depth_m.at(10, v) = 1.3F;  // a smaller group, 30 cm behind
  GeometricSegmentationOptions options = smap_for_small_clouds();
  options.leaf_size_m = 0.0;
  const auto found = segment(frame, whole_image(), options);
  EXPECT_EQ(found->pixel_indices.size(), 110U);
  EXPECT_NEAR(found->box.max_in_map.z(), 1.0, 1e-6);
}

// [smap] pseudocode 3.1.
TEST(ClusterPolicy, DropsStatisticalOutliers) {
  RgbdFrame frame = plate();
  frame.depth_m.at(15, 15) = 1.0F;  // alone, 6 cm from the plate
  GeometricSegmentationOptions options = smap_for_small_clouds();
  options.leaf_size_m = 0.0;
  options.cluster_gap_m = 0.0;
  EXPECT_EQ(segment(frame, whole_image(), options)->pixel_indices.size(), 122U);
  options.outlier_neighbours = 8;
  options.outlier_stddev = 3.0;
  EXPECT_EQ(segment(frame, whole_image(), options)->pixel_indices.size(), 121U);
}

// Table D.1: clusters of fewer than 50 voxels of 3 cm are no object, so a cup is none for [smap].
TEST(ClusterPolicy, LosesSmallThingsAsPrinted) {
  const auto found = segment(plate(), whole_image(), smap_segmentation());
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, ErrorCode::kNotFound);
  EXPECT_NE(found.error().what.find("clusters"), std::string::npos);
}

// Two boards at right angles to the view, the nearer one larger: each is smooth, a gap parts them.
TEST(RegionGrowingPolicy, KeepsTheLargestSmoothRegion) {
  BoxScene scene;
  scene.add(1, {1.5, -0.4, 0.6}, {1.52, 0.4, 1.4}).add(2, {2.0, -0.4, 1.4}, {2.02, 0.4, 2.0});
  const SceneView view = scene.view(test::look_at({0, 0, 1.2}, {1.5, 0, 1.2}));
  Detection both;
  both.box_px = {0, 0, 640, 480};
  GeometricSegmentationOptions options = hypermap_segmentation();
  options.max_range_m = 3.0;
  const auto found = segment(view.frame, both, options);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_GE(test::pixel_overlap(found->pixel_indices, view.truth, 1), 0.95);
}

class EveryPolicy : public testing::TestWithParam<SegmentationPolicy> {
 protected:
  [[nodiscard]] GeometricSegmentationOptions options() const { return {.policy = GetParam()}; }
};

TEST_P(EveryPolicy, SaysThatNothingIsThere) {
  RgbdFrame frame = plate();
  for (float& depth : frame.depth_m.pixels()) depth = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(segment(frame, whole_image(), options()).error().code, ErrorCode::kNotFound);
  Detection outside;
  outside.box_px = {50, 50, 60, 60};
  EXPECT_EQ(segment(plate(), outside, options()).error().code, ErrorCode::kNotFound);
  Detection empty_mask = whole_image();
  empty_mask.mask = MaskImage(20, 20);
  EXPECT_EQ(segment(plate(), empty_mask, options()).error().code, ErrorCode::kNotFound);
}

TEST_P(EveryPolicy, SurvivesHolesInTheDepth) {
  SceneView view = office_view(6);
  for (std::size_t i = 0; i < view.frame.depth_m.size(); i += 7) {
    const float bad[] = {0.0F,
                         -1.0F,
                         std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity()};
    view.frame.depth_m.pixels()[i] = bad[(i / 7) % 4];
  }
  const auto found = segment(view.frame, detection_of(view, kScreen), options());
  ASSERT_TRUE(found.has_value());
  for (const std::uint32_t pixel : found->pixel_indices) EXPECT_NE(pixel % 7, 0U);
  for (const auto& point : found->points_in_map) EXPECT_TRUE(point.allFinite());
}

TEST_P(EveryPolicy, GivesTheSameWithAnyNumberOfThreads) {
  const SceneView view = office_view(7);
  std::vector<Detection> detections;
  for (const int label : {kScreen, kKeyboard, kMouse, kCup}) {
    detections.push_back(detection_of(view, label));
  }
  const auto one = segment_all(view.frame, detections, options(), 1);
  const auto three = segment_all(view.frame, detections, options(), 3);
  ASSERT_EQ(one.size(), detections.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].has_value(), three[i].has_value());
    if (one[i]) {
      EXPECT_EQ(*one[i], *three[i]);
    }
  }
}

// [smap] Eq. (3.5): a row has a 3D box and its confidence.
TEST_P(EveryPolicy, DescribesItsOwnPoints) {
  const SceneView view = office_view(8);
  const auto found = segment(view.frame, detection_of(view, kScreen), options());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->box, bounding_box(found->points_in_map));
  EXPECT_EQ(found->centroid_in_map, found->box.centre());
  EXPECT_TRUE(std::is_sorted(found->pixel_indices.begin(), found->pixel_indices.end()));
  EXPECT_GT(found->box_confidence.value(), 0.8);
}

INSTANTIATE_TEST_SUITE_P(Policies,
                         EveryPolicy,
                         testing::Values(SegmentationPolicy::kForeground,
                                         SegmentationPolicy::kCluster,
                                         SegmentationPolicy::kRegionGrowing));

TEST(SegmentationPresets, AreThoseOfTheSources) {
  const GeometricSegmentationOptions smap = smap_segmentation();  // [smap] table D.1
  EXPECT_EQ(smap.policy, SegmentationPolicy::kCluster);
  EXPECT_EQ(smap.min_range_m, 0.2);
  EXPECT_EQ(smap.max_range_m, 1.7);
  EXPECT_EQ(smap.leaf_size_m, 0.03);
  EXPECT_EQ(smap.outlier_neighbours, 8);
  EXPECT_EQ(smap.outlier_stddev, 0.3);
  EXPECT_EQ(smap.cluster_min_points, 50);
  EXPECT_EQ(smap.cluster_max_points, 10000);
  EXPECT_EQ(smap.cluster_gap_m, 0.065);
  EXPECT_EQ(smap.depth_slack_m, 0.2);
  const GeometricSegmentationOptions hypermap = hypermap_segmentation();  // [hypermap] 5.2.2
  EXPECT_EQ(hypermap.policy, SegmentationPolicy::kRegionGrowing);
  EXPECT_DOUBLE_EQ(hypermap.region_growing.angle_threshold_rad, 0.3490658503988659);  // 20 degrees
  EXPECT_EQ(hypermap.region_growing.curvature_threshold, 1.0);
  for (const auto& options : {smap, hypermap, GeometricSegmentationOptions{}}) {
    EXPECT_TRUE(validate(options).has_value());
  }
}

TEST(SegmentationRules, NameTheBrokenField) {
  GeometricSegmentationOptions options;
  options.max_range_m = 0.1;
  EXPECT_EQ(validate(options).error().field, "max_range_m");
  options = {};
  options.leaf_size_m = 1e-9;
  EXPECT_EQ(validate(options).error().field, "leaf_size_m");
  options = {};
  options.foreground.max_points = 0;
  EXPECT_EQ(validate(options).error().field, "foreground.max_points");
  options = {};
  options.foreground.plane_min_share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(options).error().field, "foreground.plane_min_share");
  options = {};
  options.region_growing.angle_threshold_rad = 0.0;
  EXPECT_EQ(validate(options).error().field, "region_growing.angle_threshold_rad");
  options = {};
  options.cluster_max_points = 10;
  EXPECT_EQ(validate(options).error().field, "cluster_max_points");
}

}  // namespace
}  // namespace hypermap
