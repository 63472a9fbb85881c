// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Missed detections: how an object decays when a frame does not show it.
///
/// Source: [smap] 3.5.5, figure 3.23; [hypermap] 3.4.5 (visible area).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/objects/object_scope.hpp"
#include "hypermap/core/objects/observation_log.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What one frame says about the place of one object.
struct VisibilityResult {
  ObjectId object;
  Visibility state = Visibility::kOutOfView;
  double visible_fraction = 0.0;  ///< Of the object: its surface is there and open, in [0, 1].
  double absent_fraction = 0.0;   ///< Of the object: the camera looks through it, in [0, 1].
  double bearing_rad = 0.0;       ///< Of the camera seen from the object, map frame.
  double distance_m = 0.0;        ///< From the camera to the object's centroid.
  friend bool operator==(const VisibilityResult&, const VisibilityResult&) = default;
};

/// How the visibility of the known objects in a frame is evaluated.
enum class VisibilityPolicy {
  kRays,    ///< Rays to the object's points; given by the 3D map. Ours.
  kHull,    ///< Inside the hull of all that the frame shows, from above. [hypermap] 3.4.5
  kPanels,  ///< Corners of the box against the binned depth map. [smap] 3.5.5
};

/// When an object leaves the map.
enum class RemovalRule {
  kExistence,   ///< Existence below `min_existence`. Public implementation of [hypermap].
  kConfidence,  ///< Object confidence below `min_confidence`. Source: [smap] figure 3.23, C.3
};

struct AbsenceOptions {
  VisibilityPolicy policy = VisibilityPolicy::kRays;
  /// Taken from the existence when the object is visible and not detected.
  LogOdds missed_decay{0.2};
  /// Taken from the existence when the object is not where it should be.
  LogOdds absent_decay{1.0};
  /// Taken from all classes when absent.
  LogOdds absent_class_decay{0.5};
  /// Share of the absent decay of classes and histogram that applies when partly occluded; off by
  /// default, since what is seen there is seen. Deviation: in [smap] it is more than 0, without a
  /// number.
  double partly_occluded_factor = 0.0;
  /// The same when occluded: "a small decay"; off by default.
  double occluded_factor = 0.0;
  /// Share of any decay that applies from a side on which the object was never detected, see
  /// `was_detected_from`: something may hide it there. 1: all sides are alike.
  /// Source: [smap] 3.5.2, figure 3.18, without a number.
  double unseen_side_factor = 1.0 / 3.0;
  /// Objects that this frame did detect lose nothing.
  bool spare_seen = true;
  /// Farther than this times the farthest distance at which it was ever detected, a detection is
  /// not expected; 0 expects it everywhere.
  double expected_range_factor = 1.1;
  RemovalRule removal = RemovalRule::kExistence;
  LogOdds min_existence{-2.0};              ///< For rule existence.
  Probability min_confidence{0.5};          ///< For rule confidence, o_valid.
  ObjectConfidenceOptions confidence = {};  ///< For rule confidence.
  /// Policy panels: objects at vertices of the topological map that at most so many edges lie
  /// between the sensor's and; none: anywhere.                            [smap] 3.5.5, step 1
  std::optional<int> graph_layers = 5;
  double panel_tolerance_m = 0.1;  ///< Widens the box against panels.
  double absent_share = 0.5;       ///< Share of panels after the box that means absent.
  double occluded_share = 0.5;     ///< Share of panels before the box that means occluded.

  friend bool operator==(const AbsenceOptions&, const AbsenceOptions&) = default;
};

/// Errors: kInvalidArgument naming the first field out of its range.
[[nodiscard]] Result<void> validate(const AbsenceOptions& options);
[[nodiscard]] const OptionTable& option_table(const AbsenceOptions& options);

struct AbsenceReport {
  std::size_t num_visible = 0;
  std::size_t num_partly_occluded = 0;
  std::size_t num_occluded = 0;
  std::size_t num_absent = 0;
  std::size_t num_out_of_view = 0;
  std::vector<ObjectId> removed;  ///< Ascending.
};

/// Negative association, missed detections: decays objects that were visible or absent and not
/// detected, keeps occluded ones, removes those below the removal threshold.
///
/// Results about objects that are not in the map are left out. `detected`, ascending, are the
/// objects that this frame detected.
/// Requires: validate(options), at most one result per object.
AbsenceReport apply_absences(ObjectMap& objects,
                             std::span<const VisibilityResult> results,
                             const AbsenceOptions& options,
                             std::span<const ObjectId> detected = {},
                             std::uint64_t frame_index = 0,
                             Stamp stamp = {});

/// Policy hull: objects whose centroid lies inside the convex hull, from above, of all that the
/// frame shows within `max_range_m` are visible. Occluded ones too: that is the source's.
/// Source: [hypermap] 3.4.4 (visibility area).
/// Errors: kNotFound when the frame shows no area.
[[nodiscard]] Result<std::vector<VisibilityResult>> evaluate_visibility_by_hull(
    const ObjectMap& objects, const RgbdFrame& frame, double max_range_m);

/// Policy panels, of the objects in `scope`: each corner of a box takes the panel nearest by angle,
/// outside the image as well; of the panels that these span some lie before, inside or after the
/// box. Boundary: no result when no panel of a frame has a point.
/// Source: [smap] figure 3.23, Eq. (3.22) to (3.25), figure 3.24.
/// Cost: linear in the panels, for each object in scope.
[[nodiscard]] std::vector<VisibilityResult> evaluate_visibility_by_panels(
    const ObjectMap& objects,
    const BinnedDepthMap& depth,
    const AbsenceOptions& options,
    const ObjectScope& scope = {});

}  // namespace hypermap
