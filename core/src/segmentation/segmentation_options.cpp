// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <cmath>
#include <string>

namespace hypermap {
namespace {

Result<void> check(bool holds, const char* rule, double value, const std::string& field) {
  if (holds) return {};
  return fail(ErrorCode::kInvalidArgument, std::string(rule) + ", is " + number_text(value), field);
}

Result<void> check_not_negative(double value, const char* field) {
  return check(std::isfinite(value) && value >= 0.0, "must be finite and >= 0", value, field);
}

Result<void> check_positive(double value, const char* field) {
  return check(std::isfinite(value) && value > 0.0, "must be finite and > 0", value, field);
}

Result<void> check_share(double value, const char* field) {
  return check(value >= 0.0 && value <= 1.0, "must be in 0..1", value, field);
}

Result<void> check_count(int value, int least, const char* field) {
  return check(value >= least,
               ("must be >= " + std::to_string(least)).c_str(),
               static_cast<double>(value),
               field);
}

/// Finer grids would exhaust the voxel keys within the sensor's range.
Result<void> check_leaf(double value, const char* field) {
  return check(value == 0.0 || (value >= 1e-4 && std::isfinite(value)),
               "must be 0 or finite and >= 0.0001",
               value,
               field);
}

Result<void> validate(const ForegroundOptions& options) {
  HYPERMAP_TRY(check_not_negative(options.context_share, "foreground.context_share"));
  HYPERMAP_TRY(check_count(options.context_min_px, 0, "foreground.context_min_px"));
  HYPERMAP_TRY(check_count(options.max_planes, 0, "foreground.max_planes"));
  HYPERMAP_TRY(check_share(options.plane_min_share, "foreground.plane_min_share"));
  HYPERMAP_TRY(check_positive(options.plane_thickness_m, "foreground.plane_thickness_m"));
  HYPERMAP_TRY(check_not_negative(options.noise_factor, "foreground.noise_factor"));
  HYPERMAP_TRY(check_positive(options.depth_step_m, "foreground.depth_step_m"));
  HYPERMAP_TRY(check_not_negative(options.depth_step_per_m, "foreground.depth_step_per_m"));
  HYPERMAP_TRY(check_not_negative(options.part_gap_m, "foreground.part_gap_m"));
  HYPERMAP_TRY(check_not_negative(options.part_height_gap_m, "foreground.part_height_gap_m"));
  HYPERMAP_TRY(check_share(options.part_max_outside, "foreground.part_max_outside"));
  HYPERMAP_TRY(check_leaf(options.point_spacing_m, "foreground.point_spacing_m"));
  HYPERMAP_TRY(check_count(options.max_points, 1, "foreground.max_points"));
  return check_count(options.min_pixels, 1, "foreground.min_pixels");
}

Result<void> validate(const RegionGrowingOptions& options) {
  HYPERMAP_TRY(check(options.angle_threshold_deg > 0.0 && options.angle_threshold_deg <= 90.0,
                     "must be in (0, 90]",
                     options.angle_threshold_deg,
                     "region_growing.angle_threshold_deg"));
  HYPERMAP_TRY(
      check_not_negative(options.curvature_threshold, "region_growing.curvature_threshold"));
  HYPERMAP_TRY(check_count(options.normal_neighbours, 3, "region_growing.normal_neighbours"));
  HYPERMAP_TRY(check_count(options.region_neighbours, 1, "region_growing.region_neighbours"));
  return check_count(options.region_min_points, 1, "region_growing.region_min_points");
}

}  // namespace

Result<void> validate(const GeometricSegmentationOptions& options) {
  HYPERMAP_TRY(check_not_negative(options.min_range_m, "min_range_m"));
  HYPERMAP_TRY(check(options.max_range_m > options.min_range_m && options.max_range_m <= 100.0,
                     "must be in (min_range_m, 100]",
                     options.max_range_m,
                     "max_range_m"));
  HYPERMAP_TRY(check_leaf(options.leaf_size_m, "leaf_size_m"));
  HYPERMAP_TRY(check_count(options.outlier_neighbours, 0, "outlier_neighbours"));
  HYPERMAP_TRY(check_not_negative(options.outlier_stddev, "outlier_stddev"));
  HYPERMAP_TRY(check_not_negative(options.cluster_gap_m, "cluster_gap_m"));
  HYPERMAP_TRY(check_count(options.cluster_min_points, 1, "cluster_min_points"));
  HYPERMAP_TRY(
      check_count(options.cluster_max_points, options.cluster_min_points, "cluster_max_points"));
  HYPERMAP_TRY(check_not_negative(options.depth_slack_m, "depth_slack_m"));
  HYPERMAP_TRY(validate(options.foreground));
  return validate(options.region_growing);
}

GeometricSegmentationOptions smap_segmentation() {
  return {.policy = SegmentationPolicy::kCluster,
          .min_range_m = 0.2,
          .max_range_m = 1.7,
          .leaf_size_m = 0.03,
          .outlier_neighbours = 8,
          .outlier_stddev = 0.3,
          .cluster_gap_m = 0.065,
          .cluster_min_points = 50,
          .cluster_max_points = 10000,
          .depth_slack_m = 0.2};
}

GeometricSegmentationOptions hypermap_segmentation() {
  return {.policy = SegmentationPolicy::kRegionGrowing,
          .region_growing = {.angle_threshold_deg = 20.0, .curvature_threshold = 1.0}};
}

}  // namespace hypermap
