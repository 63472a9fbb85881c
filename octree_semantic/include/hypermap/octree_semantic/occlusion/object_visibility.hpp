// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Visibility of each known object in a frame: visible, occluded, or absent.
///
/// Source: [smap] 3.5.5 and figure 3.23 use panels of a binned depth map. Deviation: policy
/// `rays`: rays from the camera to points of the object, against what this frame measured along
/// them and, where it measured nothing, against the map's own geometry. So an object behind a table
/// is occluded, and one that is only seen from behind is not absent. What is measured inside an
/// object's box, before its points, is its own near side, unless it was detected from within 40 to
/// 60 degrees of there and has no points there: then it is the table that the box reaches into.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/max_range.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

struct VisibilityOptions {
  int max_rays = 128;  ///< Rays per object at most, spread evenly over it.
  /// Farther points are out of view. None: as the map's range in a mapper, kDefaultMaxRangeM alone.
  std::optional<double> max_range_m = std::nullopt;
  double depth_tolerance_m = 0.08;        ///< Measured and expected depth agree within this,
  double depth_tolerance_per_m2 = 0.005;  ///< plus this times the depth squared. Kinect: 0.003
  double min_in_view_share = 0.25;        ///< Less of the object in the image: out of view.
  /// Less of what can be told is open to the camera: occluded.
  double min_open_share = 0.1;
  /// At least so much of what is open shows what lies behind: absent, where it is as much of what
  /// is open or beside the image; else out of view.
  double absent_share = 0.5;
  /// At least so much of what can be told is hidden: partly occluded.
  double partly_occluded_share = 0.3;
  friend bool operator==(const VisibilityOptions&, const VisibilityOptions&) = default;
};
/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const VisibilityOptions& options);
[[nodiscard]] const OptionTable& option_table(const VisibilityOptions& options);

/// Occlusion of rays, 1 where occluded, in their order; as OcclusionScene::occluded.
using OcclusionQuery =
    std::function<Result<std::vector<std::uint8_t>>(std::span<const OcclusionRay>)>;

/// One result for each object whose box intersects the view frustum's bounds, by ascending id.
/// `detected`, ascending, are objects that this frame detected: those are never occluded or absent.
/// `query` is called once with all rays without depth, and not at all when there are none: then the
/// scene need not be updated.
///
/// Errors: those of `query`.
/// Boundary: a ray without depth that the map does not occlude is undecided; an object without
/// decided rays is out of view. An object without points has rays to the corners and the centre of
/// its box. Requires: validate(options), validate(frame).
[[nodiscard]] Result<std::vector<VisibilityResult>> evaluate_visibility(
    const ObjectMap& objects,
    const RgbdFrame& frame,
    const OcclusionQuery& query,
    const VisibilityOptions& options = {},
    std::span<const ObjectId> detected = {});

}  // namespace hypermap
