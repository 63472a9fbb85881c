// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_pipeline_options.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

TEST(Presets, SmapIsItsTables) {
  const ObjectPipelineOptions o = preset(PresetName::kSmap);
  // [smap] table D.1
  EXPECT_EQ(o.segmentation.policy, SegmentationPolicy::kCluster);
  EXPECT_DOUBLE_EQ(o.segmentation.min_range_m, 0.2);
  EXPECT_EQ(o.segmentation.max_range_m, 1.7);
  EXPECT_DOUBLE_EQ(o.segmentation.leaf_size_m, 0.03);
  EXPECT_EQ(o.segmentation.outlier_neighbours, 8);
  EXPECT_DOUBLE_EQ(o.segmentation.outlier_stddev, 0.3);
  EXPECT_EQ(o.segmentation.cluster_min_points, 50);
  EXPECT_EQ(o.segmentation.cluster_max_points, 10000);
  EXPECT_DOUBLE_EQ(o.segmentation.cluster_gap_m, 0.065);
  EXPECT_DOUBLE_EQ(o.segmentation.depth_slack_m, 0.2);
  // [smap] table D.2
  EXPECT_EQ(o.binned_depth.columns, 24);
  EXPECT_EQ(o.binned_depth.rows, 16);
  const VisibilityHistogramOptions& h = o.association.histogram;
  EXPECT_DOUBLE_EQ(h.base_increment, 2.0);
  EXPECT_EQ(h.weights, (std::array<double, 5>{0.5, 1.5, 6.0, 1.5, 0.5}));
  EXPECT_EQ(h.num_bins, 18);
  EXPECT_DOUBLE_EQ(h.min_log_odds.value(), -10.0);
  EXPECT_DOUBLE_EQ(h.max_log_odds.value(), 10.0);
  EXPECT_DOUBLE_EQ(h.visible_above, 0.7);
  EXPECT_DOUBLE_EQ(h.hidden_below, 0.4);
  EXPECT_DOUBLE_EQ(o.association.belief.min_log_odds.value(), -10.0);
  EXPECT_DOUBLE_EQ(o.association.belief.max_log_odds.value(), 10.0);
  EXPECT_DOUBLE_EQ(o.association.position_error_m, 0.2);
  EXPECT_DOUBLE_EQ(o.association.tracking_factor, 0.5);
  EXPECT_DOUBLE_EQ(o.absence.min_confidence.value(), 0.5);
  EXPECT_EQ(o.absence.confidence.rule, ConfidenceRule::kWeighted);
  // Chapter 3
  EXPECT_EQ(o.association.policy, AssociationPolicy::kSmap);
  EXPECT_EQ(o.association.belief.saturation, Saturation::kClamp);
  EXPECT_EQ(o.absence.policy, VisibilityPolicy::kPanels);
  EXPECT_EQ(o.absence.removal, RemovalRule::kConfidence);
  EXPECT_GT(o.absence.occluded_factor, 0.0);
  EXPECT_FALSE(o.association.box_from_points);
}

TEST(Presets, HypermapIsItsText) {
  const ObjectPipelineOptions o = preset(PresetName::kHypermap);
  // [hypermap] 3.4.4, 5.2.2
  EXPECT_EQ(o.segmentation.policy, SegmentationPolicy::kRegionGrowing);
  EXPECT_DOUBLE_EQ(o.segmentation.region_growing.angle_threshold_rad, 0.3490658503988659);
  EXPECT_DOUBLE_EQ(o.segmentation.region_growing.curvature_threshold, 1.0);
  // [hypermap] 3.4.5
  EXPECT_EQ(o.association.policy, AssociationPolicy::kOverlap);
  EXPECT_DOUBLE_EQ(o.association.min_jaccard, 0.2);
  EXPECT_DOUBLE_EQ(o.association.radius_m, 0.5);
  EXPECT_DOUBLE_EQ(o.association.new_existence.value(), 1.0);
  EXPECT_DOUBLE_EQ(o.association.seen_existence.value(), 1.0);
  EXPECT_DOUBLE_EQ(o.association.max_existence.value(), 20.0);
  EXPECT_DOUBLE_EQ(o.absence.missed_decay.value(), 0.2);
  EXPECT_FALSE(o.absence.spare_seen);
  EXPECT_DOUBLE_EQ(o.absence.min_existence.value(), -5.0);
  EXPECT_EQ(o.absence.policy, VisibilityPolicy::kHull);
  EXPECT_DOUBLE_EQ(o.confirmation.min_existence->value(), 2.0);
  EXPECT_EQ(o.footprint, ShapePolicy::kBest);
}

TEST(Presets, AllAreValidAndHaveNames) {
  for (const PresetName name : {PresetName::kDefault, PresetName::kSmap, PresetName::kHypermap}) {
    const auto valid = validate(preset(name));
    EXPECT_TRUE(valid.has_value()) << (valid ? "" : to_string(valid.error()));
    EXPECT_EQ(preset_of(to_string(name)), name);
  }
  EXPECT_FALSE(preset_of("Default").has_value());
}

TEST(Presets, ErrorsNameTheStage) {
  ObjectPipelineOptions options;
  options.association.radius_m = -1.0;
  EXPECT_EQ(validate(options).error().field, "association.radius_m");
}

TEST(TransientNames, OfTheDefaultArePeopleInAnySpelling) {
  for (const char* name : {"person", "Person"}) EXPECT_TRUE(is_transient_by_default(name)) << name;
  for (const char* name : {"", "people", "chair"})
    EXPECT_FALSE(is_transient_by_default(name)) << name;
}

TEST(TransientNames, AreAllButPeopleWhomNoClassMeans) {
  ClassRegistry classes;
  ASSERT_TRUE(classes.add("chair"));
  ObjectPipelineOptions options;
  EXPECT_EQ(transient_names(options, classes), std::vector<std::string>{});
  options.transient_class_names = {"Person", "ghost"};
  EXPECT_EQ(transient_names(options, classes), std::vector<std::string>{"ghost"});
  ASSERT_TRUE(classes.add("PERSON"));
  EXPECT_EQ(transient_names(options, classes), options.transient_class_names);
  EXPECT_TRUE(preset(PresetName::kSmap).transient_class_names.empty());
  EXPECT_TRUE(preset(PresetName::kHypermap).transient_class_names.empty());
}

}  // namespace
}  // namespace hypermap
