// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Segmentation of real Kinect depth, judged by labels that people drew.
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "support/box_scene.hpp"
#include "support/pcd_file.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

constexpr const char* kCloud = "clouds/mOSD/learn0.pcd";

/// Two objects (labels 20 and 30) on a table (label 1). The camera's pitch is not stored; the plane
/// through the pixels labelled as table is 36.9 degrees off its axis, which is a slope of 3 to 4.
test::SceneView labelled_table() {
  const test::PcdCloud cloud = test::read_pcd(test::shared_data(kCloud));
  test::SceneView view;
  view.frame.camera = test::kinect_camera();
  view.frame.map_from_camera = test::look_at({0, 0, 1}, {1, 0, 0.25});
  view.frame.depth_m = DepthImage(cloud.width, cloud.height);
  view.truth = LabelImage(cloud.width, cloud.height);
  for (std::size_t i = 0; i < view.truth.size(); ++i) {
    view.frame.depth_m.pixels()[i] = cloud.number("z", i);
    view.truth.pixels()[i] = static_cast<std::int32_t>(cloud.fields.at("label")[i]);
  }
  return view;
}

double overlap_with(const test::SceneView& view,
                    int label,
                    const GeometricSegmentationOptions& options) {
  Detection detection;
  detection.box_px = test::tight_box(view.truth, label).value();
  const Result<Segment> found = segment(view.frame, detection, options);
  return found ? test::pixel_overlap(found->pixel_indices, view.truth, label) : 0.0;
}

TEST(RealKinectTable, OurSegmentsAreThoseThatPeopleDrew) {
  HYPERMAP_REQUIRE_SHARED_DATA(kCloud);
  const test::SceneView view = labelled_table();
  for (const int label : {20, 30}) EXPECT_GE(overlap_with(view, label, {}), 0.95);
}

TEST(RealKinectTable, OursBeatsBothSourcesOnEachThing) {
  HYPERMAP_REQUIRE_SHARED_DATA(kCloud);
  const test::SceneView view = labelled_table();
  for (const int label : {20, 30}) {
    const double ours = overlap_with(view, label, {});
    EXPECT_GT(ours, overlap_with(view, label, smap_segmentation()));
    EXPECT_GT(ours, overlap_with(view, label, hypermap_segmentation()));
  }
}

}  // namespace
}  // namespace hypermap
