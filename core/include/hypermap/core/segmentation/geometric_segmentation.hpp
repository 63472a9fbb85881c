// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which depth pixels inside a detection's box are the detected object.
///
/// Source: [smap] 3.3, table D.1; [hypermap] 3.4.4, 5.2.2.
#pragma once

#include "hypermap/core/base/max_range.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/core/segmentation/segment.hpp"

#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// How the object is separated from the background of its box.
enum class SegmentationPolicy {
  /// Ours: what continues outside the box is background (floor, table top, wall, neighbours); of
  /// the rest, the surfaces that fill the box best. What a mask shows is the object, but for strips
  /// at its edge that go on outside it and what is seen through the object. Works in the image's
  /// order, so that a cup of 300 pixels survives.
  kForeground,
  /// [smap] 3.3: range, voxel grid, statistical outliers, largest Euclidean cluster.
  kCluster,
  /// [hypermap] 3.4.4: region growing on normals, largest region.
  kRegionGrowing,
};

/// Policy `kForeground`. Deviation: in neither source; both keep the largest cluster, which for a
/// small object on a table is the table. Where a detection has a mask, the surroundings are those
/// of the mask, and parts are not asked for: all of the mask is the object.
struct ForegroundOptions {
  /// The image around the box that is searched for background, as a share of the box's sides;
  /// 0 searches nothing.
  double context_share = 0.3;
  /// At least this many pixels around the box, so that small boxes see their support. Unit: pixel.
  int context_min_px = 16;
  /// Planes taken for background at most, besides a floor of which little is seen; 0 removes none.
  /// Floor, table top, walls: 5.
  int max_planes = 5;
  /// A plane is background when it holds this share of the valid pixels around the box; the floor,
  /// when 20 of up to 500 samples of them lie on it.
  double plane_min_share = 0.06;
  /// Half thickness of a background plane without noise; the sensor's noise is added. Unit: metre.
  double plane_thickness_m = 0.007;
  /// Times the sensor's axial noise (1.2 mm + 1.9 mm (z - 0.4)^2) that a plane tolerates after
  /// smoothing.
  double noise_factor = 1.2;
  /// Neighbouring pixels with a larger step in depth are different surfaces; noise and slope are
  /// added. Unit: metre.
  double depth_step_m = 0.02;
  /// Step allowed per metre of depth, for surfaces seen at an angle. No unit.
  double depth_step_per_m = 0.015;
  /// Surfaces nearer to each other than this on the floor plan may be parts of one object; 0 keeps
  /// only the best surface. Unit: metre.
  double part_gap_m = 0.08;
  /// And this near in height: the seat of a chair and its feet. Unit: metre.
  double part_height_gap_m = 0.4;
  /// A surface with more than this share of its pixels outside the box is not a part, and what the
  /// map holds for the object there is not the object's.
  double part_max_outside = 0.12;
  /// Spacing of the points of small objects; larger objects get coarser ones. Unit: metre.
  double point_spacing_m = 0.006;
  /// Points of one segment at most; the spacing grows until they fit.
  int max_points = 2000;
  /// Fewer pixels than this are no evidence of an object.
  int min_pixels = 24;

  friend bool operator==(const ForegroundOptions&, const ForegroundOptions&) = default;
};
[[nodiscard]] const OptionTable& option_table(const ForegroundOptions& options);

/// Policy `kRegionGrowing`.
struct RegionGrowingOptions {
  /// Largest angle between normals of neighbours of one region, theta_th. Unit: radian.
  double angle_threshold_rad = 20.0 * std::numbers::pi / 180.0;
  /// Points of less curvature hand the region on, c_th. No unit.
  double curvature_threshold = 1.0;
  /// Points around a point that its normal is fitted to. Not in the source.
  int normal_neighbours = 50;
  /// Points around a point that its region may grow to. Not in the source.
  int region_neighbours = 30;
  /// Smaller regions are no object. Not in the source.
  int region_min_points = 50;

  friend bool operator==(const RegionGrowingOptions&, const RegionGrowingOptions&) = default;
};
[[nodiscard]] const OptionTable& option_table(const RegionGrowingOptions& options);

/// Farther things are not segmented: finer grids would exhaust the voxel keys. Unit: metre.
inline constexpr double kMaxSegmentedRangeM = 100.0;

/// The defaults are ours; `smap_segmentation()` and `hypermap_segmentation()` are the sources'.
struct GeometricSegmentationOptions {
  /// How the object is found.
  SegmentationPolicy policy = SegmentationPolicy::kForeground;
  /// Nearer depth is dropped, R_min. Unit: metre.
  double min_range_m = 0.2;
  /// Farther depth is dropped. None: as the map's range in a mapper, kDefaultMaxRangeM alone.
  /// Unit: metre.
  std::optional<double> max_range_m = std::nullopt;
  /// Edge of the voxel grid of both sources' policies; 0 disables; S_leaf.
  /// Unit: metre.
  double leaf_size_m = 0.03;
  /// Neighbours of the statistical outlier removal; 0 disables; mean_k.
  int outlier_neighbours = 8;
  /// Larger keeps more points, std_multiplier. Unit: standard deviation.
  double outlier_stddev = 0.3;
  /// Points farther apart separate clusters; 0 disables clustering; cluster_tol.
  /// Unit: metre.
  double cluster_gap_m = 0.065;
  /// Smaller clusters are no object, cluster_min.
  int cluster_min_points = 50;
  /// Larger clusters are no object, cluster_max.
  int cluster_max_points = 10000;
  /// Depth extent without loss of confidence, obj_ths. Unit: metre.
  double depth_slack_m = 0.2;
  /// Read by policy kForeground only.
  ForegroundOptions foreground = {};
  /// Read by policy kRegionGrowing only.
  RegionGrowingOptions region_growing = {};

  friend bool operator==(const GeometricSegmentationOptions&,
                         const GeometricSegmentationOptions&) = default;
};

/// Errors: kInvalidArgument naming the first field out of its range.
[[nodiscard]] Result<void> validate(const GeometricSegmentationOptions& options);
[[nodiscard]] const OptionTable& option_table(const GeometricSegmentationOptions& options);

/// Table D.1 of [smap] as printed.
[[nodiscard]] GeometricSegmentationOptions smap_segmentation();
/// The final values of [hypermap] 5.2.2.
[[nodiscard]] GeometricSegmentationOptions hypermap_segmentation();

/// Finds the object that `detection` names in the depth of `frame`.
///
/// Policy kForeground also looks at the boxes of `frame.detections`, when `detection` has no mask:
/// a surface that fills another box better is not this object. Whether `detection` is among them
/// does not matter.
/// Requires: validate(frame), validate(options).
/// Errors: kNotFound with the step after which nothing was left.
/// Boundary: depth that is 0, negative, NaN or infinite is no measurement; a box that leaves the
/// image is cut; a mask, where the detection has one, replaces the box.
/// Cost: kForeground O(pixels of the box and its surroundings); the others O(n log n) in its
/// points.
[[nodiscard]] Result<Segment> segment(const RgbdFrame& frame,
                                      const Detection& detection,
                                      const GeometricSegmentationOptions& options);

/// Whether another detection may still be begun; called by one thread at a time.
using MayBegin = std::function<bool()>;

/// `segment` for each detection, in parallel, in their order, `detections` in the place of
/// `frame.detections`; the same result with any number of threads. With one, on the caller's.
///
/// They are begun in the order of their scores, the highest first, equal ones as they stand; where
/// `may_begin` says no, this one and all that follow have the error kInterrupted.
/// Requires: threads >= 1.
[[nodiscard]] std::vector<Result<Segment>> segment_all(const RgbdFrame& frame,
                                                       std::span<const Detection> detections,
                                                       const GeometricSegmentationOptions& options,
                                                       int threads,
                                                       const MayBegin& may_begin = {});

}  // namespace hypermap
