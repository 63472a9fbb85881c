// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <numbers>
#include <string>

namespace hypermap {
namespace {

using Foreground = ForegroundOptions;
using Growing = RegionGrowingOptions;
using Segmentation = GeometricSegmentationOptions;

/// Finer grids would exhaust the voxel keys within the sensor's range.
constexpr double kFinestLeafM = 1e-4;

constexpr OptionRow kForegroundRows[] = {
    option::number<&Foreground::context_share>(
        "context_share",
        {0, 10},
        {.effect =
             "Image around the box that is searched for background, as a share of its sides."}),
    option::count<&Foreground::context_min_px>(
        "context_min_px",
        {0, 10000},
        {.unit = "px", .effect = "At least so many pixels around the box."}),
    option::count<&Foreground::max_planes>(
        "max_planes",
        {0, 100},
        {.effect = "Planes taken for background at most; the floor is one more."}),
    option::number<&Foreground::plane_min_share>(
        "plane_min_share",
        {0, 1},
        {.effect = "A plane with this share of the surroundings is background; a floor from 20 "
                   "samples on."}),
    option::number<&Foreground::plane_thickness_m>(
        "plane_thickness_m",
        option::above(0, 1),
        {.unit = "m", .effect = "Half thickness of a background plane, noise added."}),
    option::number<&Foreground::noise_factor>(
        "noise_factor",
        {0, 100},
        {.effect = "Times the axial noise that planes and steps tolerate."}),
    option::number<&Foreground::depth_step_m>(
        "depth_step_m",
        option::above(0, 10),
        {.unit = "m", .effect = "A larger step in depth parts two surfaces."}),
    option::number<&Foreground::depth_step_per_m>(
        "depth_step_per_m",
        {0, 10},
        {.unit = "m/m", .effect = "Step allowed for each metre of depth."}),
    option::number<&Foreground::part_gap_m>(
        "part_gap_m",
        {0, 10},
        {.unit = "m", .effect = "Surfaces nearer than this may be parts of one thing."}),
    option::number<&Foreground::part_height_gap_m>(
        "part_height_gap_m",
        {0, 100},
        {.unit = "m", .effect = "The same for parts above one another."}),
    option::number<&Foreground::part_max_outside>(
        "part_max_outside",
        {0, 1},
        {.effect = "A surface with more of it outside the box is no part, and background."}),
    option::number<&Foreground::point_spacing_m>(
        "point_spacing_m",
        option::zero_or(kFinestLeafM, 10),
        {.unit = "m", .effect = "Spacing of the points of small things."}),
    option::count<&Foreground::max_points>(
        "max_points", {1, 1000000}, {.effect = "Points of one segment at most."}),
    option::count<&Foreground::min_pixels>(
        "min_pixels", {1, 1000000}, {.effect = "Fewer pixels are no evidence."}),
};

constexpr OptionRow kRegionGrowingRows[] = {
    option::number<&Growing::angle_threshold_rad>(
        "angle_threshold_rad",
        option::above(0, std::numbers::pi / 2.0),
        {.unit = "rad",
         .source = "[hypermap] 5.2.2, 20 degrees",
         .effect = "Largest angle between normals of neighbours.",
         .hypermap = 20.0 * std::numbers::pi / 180.0}),
    option::number<&Growing::curvature_threshold>(
        "curvature_threshold",
        {0, 1000},
        {.source = "[hypermap] 5.2.2",
         .effect = "Points of less curvature hand the region on.",
         .hypermap = 1.0}),
    option::count<&Growing::normal_neighbours>(
        "normal_neighbours", {3, 10000}, {.effect = "Points that a normal is fitted to."}),
    option::count<&Growing::region_neighbours>(
        "region_neighbours",
        {1, 256},
        {.effect = "Points that a region may grow to; all are kept."}),
    option::count<&Growing::region_min_points>(
        "region_min_points", {1, 10000000}, {.effect = "Smaller regions are no thing."}),
};

constexpr std::string_view kPolicyNames[] = {"foreground", "cluster", "region_growing"};

constexpr OptionRow kSegmentationRows[] = {
    option::choice<&Segmentation::policy>(
        "policy",
        kPolicyNames,
        {.effect = "How the thing is told from what else its box shows.",
         .smap = SegmentationPolicy::kCluster,
         .hypermap = SegmentationPolicy::kRegionGrowing}),
    option::number<&Segmentation::min_range_m>("min_range_m",
                                               {0, 100},
                                               {.unit = "m",
                                                .source = "[smap] table D.1, R_min",
                                                .effect = "Nearer depth is dropped.",
                                                .smap = 0.2}),
    option::number<&Segmentation::max_range_m>(
        "max_range_m",
        option::above(0, kMaxSegmentedRangeM),
        {.unit = "m",
         .source = "[smap] table D.1, R_max: 1.7",
         .effect = "Farther depth is dropped; none: as integration.max_range_m.",
         .smap = 1.7}),
    option::number<&Segmentation::leaf_size_m>("leaf_size_m",
                                               option::zero_or(kFinestLeafM, 10),
                                               {.unit = "m",
                                                .source = "[smap] table D.1, S_leaf",
                                                .effect = "Edge of the voxel grid; 0 disables.",
                                                .smap = 0.03}),
    option::count<&Segmentation::outlier_neighbours>(
        "outlier_neighbours",
        {0, 100000},
        {.source = "[smap] table D.1, mean_k",
         .effect = "Neighbours of the outlier removal; 0 disables.",
         .smap = 8}),
    option::number<&Segmentation::outlier_stddev>("outlier_stddev",
                                                  {0, 100},
                                                  {.unit = "standard deviations",
                                                   .source = "[smap] table D.1, std_multiplier",
                                                   .effect = "Larger keeps more points.",
                                                   .smap = 0.3}),
    option::number<&Segmentation::cluster_gap_m>(
        "cluster_gap_m",
        {0, 10},
        {.unit = "m",
         .source = "[smap] table D.1, cluster_tol",
         .effect = "Points farther apart separate clusters; 0 disables.",
         .smap = 0.065}),
    option::count<&Segmentation::cluster_min_points>("cluster_min_points",
                                                     {1, 10000000},
                                                     {.source = "[smap] table D.1, cluster_min",
                                                      .effect = "Smaller clusters are no thing.",
                                                      .smap = 50}),
    option::count<&Segmentation::cluster_max_points>("cluster_max_points",
                                                     {1, 10000000},
                                                     {.source = "[smap] table D.1, cluster_max",
                                                      .effect = "Larger clusters are no thing.",
                                                      .smap = 10000}),
    option::number<&Segmentation::depth_slack_m>(
        "depth_slack_m",
        {0, 100},
        {.unit = "m",
         .source = "[smap] table D.1, obj_ths",
         .effect = "Depth extent without loss of confidence.",
         .smap = 0.2}),
    option::section<&Segmentation::foreground>("foreground"),
    option::section<&Segmentation::region_growing>("region_growing"),
};

Result<void> check_segmentation(const Segmentation& options) {
  const double max_range_m = options.max_range_m.value_or(kDefaultMaxRangeM);
  if (!(max_range_m > options.min_range_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be above min_range_m (" + number_text(options.min_range_m) + "), is " +
                    number_text(max_range_m),
                "max_range_m");
  }
  if (options.cluster_max_points >= options.cluster_min_points) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at least cluster_min_points (" + std::to_string(options.cluster_min_points) +
                  "), is " + std::to_string(options.cluster_max_points),
              "cluster_max_points");
}

}  // namespace

const OptionTable& option_table(const ForegroundOptions&) {
  static constexpr OptionTable kTable{kForegroundRows};
  return kTable;
}

const OptionTable& option_table(const RegionGrowingOptions&) {
  static constexpr OptionTable kTable{kRegionGrowingRows};
  return kTable;
}

const OptionTable& option_table(const GeometricSegmentationOptions&) {
  static constexpr OptionTable kTable{kSegmentationRows, kRule<check_segmentation>};
  return kTable;
}

Result<void> validate(const GeometricSegmentationOptions& options) {
  return check_options(options);
}

GeometricSegmentationOptions smap_segmentation() {
  return preset_options<GeometricSegmentationOptions>(PresetName::kSmap);
}

GeometricSegmentationOptions hypermap_segmentation() {
  return preset_options<GeometricSegmentationOptions>(PresetName::kHypermap);
}

}  // namespace hypermap
