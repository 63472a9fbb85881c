// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/segmentation_trace.hpp"

#include "support/box_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace hypermap {
namespace {

using test::SceneView;

/// A box seen at its edge: three faces that meet at right angles.
SceneView corner_view() {
  test::BoxScene scene;
  scene.add(1, {1.2, 0.2, 0.0}, {1.7, 0.7, 1.0});
  return scene.view(test::look_at({0, 0, 1.6}, {1.4, 0.4, 0.7}), 1);
}

Detection the_box(const SceneView& view) {
  Detection detection;
  detection.box_px = test::tight_box(view.truth, 1).value();
  return detection;
}

std::vector<std::string> step_names(const SegmentationTrace& trace) {
  std::vector<std::string> names;
  for (const SegmentationStep& step : trace.steps) names.push_back(step.name);
  return names;
}

class TraceOfEveryPolicy : public testing::TestWithParam<SegmentationPolicy> {};

TEST_P(TraceOfEveryPolicy, EndsInTheSegmentOfTheUntracedCall) {
  const SceneView view = corner_view();
  const GeometricSegmentationOptions options{.policy = GetParam()};
  const SegmentationTrace trace = trace_segmentation(view.frame, the_box(view), options);
  ASSERT_TRUE(trace.segment.has_value());
  EXPECT_EQ(*trace.segment, *segment(view.frame, the_box(view), options));
  for (const SegmentationStep& step : trace.steps) {
    EXPECT_EQ(step.labels.width_px(), 640);
    EXPECT_GT(step.num_points, 0U);
    EXPECT_GE(step.seconds, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Policies,
                         TraceOfEveryPolicy,
                         testing::Values(SegmentationPolicy::kForeground,
                                         SegmentationPolicy::kCluster,
                                         SegmentationPolicy::kRegionGrowing));

TEST(SegmentationTrace, ListsTheStepsOfTheSources) {
  const SceneView view = corner_view();
  EXPECT_THAT(step_names(trace_segmentation(view.frame, the_box(view), smap_segmentation())),
              testing::ElementsAre("crop", "range", "voxel grid", "outliers", "clusters"));
  EXPECT_THAT(step_names(trace_segmentation(view.frame, the_box(view), hypermap_segmentation())),
              testing::ElementsAre("crop", "range", "regions", "voxel grid"));
}

// [hypermap] 5.2.2: with 3 degrees objects fall into many small segments, with 20 they hold
// together.
TEST(SegmentationTrace, ShowsMoreAndSmallerRegionsAtThreeDegreesThanAtTwenty) {
  const SceneView view = corner_view();
  GeometricSegmentationOptions options = hypermap_segmentation();
  const auto regions_of = [&](double angle_deg) {
    options.region_growing.angle_threshold_rad = angle_deg * std::numbers::pi / 180.0;
    return trace_segmentation(view.frame, the_box(view), options).steps.at(2);
  };
  const SegmentationStep coarse = regions_of(20.0);
  const SegmentationStep fine = regions_of(3.0);
  EXPECT_LT(fine.num_points, coarse.num_points);
  const auto in_no_segment = [](const SegmentationStep& step) {
    return std::count(step.labels.pixels().begin(), step.labels.pixels().end(), kLabelNone);
  };
  EXPECT_GT(in_no_segment(fine), in_no_segment(coarse));
}

TEST(SegmentationTrace, KeepsTheStepsUntilNothingIsLeft) {
  SceneView view = corner_view();
  GeometricSegmentationOptions options = smap_segmentation();
  options.max_range_m = 0.3;
  const SegmentationTrace trace = trace_segmentation(view.frame, the_box(view), options);
  EXPECT_FALSE(trace.segment.has_value());
  EXPECT_THAT(step_names(trace), testing::ElementsAre("crop", "range"));
  EXPECT_EQ(trace.steps[1].num_points, 0U);
}

// [hypermap] 5.2.2: "red pixels do not belong to any segment", other colours tell segments.
TEST(RenderLabels, PaintsNoSegmentRedAndLeavesTheBackground) {
  LabelImage labels(4, 1, kLabelAbsent);
  labels.at(1, 0) = kLabelNone;
  labels.at(2, 0) = 1;
  labels.at(3, 0) = 2;
  const ColorImage image = render_labels(labels, ColorImage(4, 1, {9, 9, 9}));
  EXPECT_EQ(image.at(0, 0), (Rgb8{9, 9, 9}));
  EXPECT_EQ(image.at(1, 0), (Rgb8{255, 0, 0}));
  EXPECT_NE(image.at(2, 0), image.at(3, 0));
  EXPECT_EQ(render_labels(labels).at(0, 0), (Rgb8{0, 0, 0}));
}

}  // namespace
}  // namespace hypermap
