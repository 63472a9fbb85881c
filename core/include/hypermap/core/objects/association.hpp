// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which object of the map an observation shows, and the update of that object.
///
/// Source: [hypermap] 3.4.5 (policies `overlap` and `radius`); [smap] 3.5.4, figure 3.22 (policy
/// `smap`); policy `assignment` is ours.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"
#include "hypermap/core/objects/class_belief.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/objects/object_scope.hpp"
#include "hypermap/core/objects/visibility_histogram.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/core/segmentation/segment.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// One detected and segmented object of one frame.
struct Observation {
  Segment segment;
  /// Class vector, sorted by id, summing to 1.
  std::vector<ClassEvidence> class_scores;
  Probability score;  ///< Of the detection.
  DetectorId detector;
  double bearing_rad = 0.0;  ///< Of the camera seen from the segment's centroid, map frame.
  double distance_m = 0.0;   ///< From the camera to the segment's centroid.
  Stamp stamp;
  std::uint64_t frame_index = 0;
  /// Classes of the combined set, all that any detector can name now; at least those of
  /// `class_scores` and two count.
  std::size_t num_classes = 0;
  std::vector<Embedding> embeddings = {};  ///< Of the detection.
  PixelBox box_px = {};                    ///< Around the detection's box and mask.
  ClassPrior prior = {};                   ///< What is known of its class besides.
};

/// What a detection and its segment say about the map, seen from the frame's camera.
[[nodiscard]] Observation make_observation(const RgbdFrame& frame,
                                           const Detection& detection,
                                           Segment segment);

/// Bearing of the camera seen from the object in the map frame, in (-pi, pi]. Source: [smap]
/// figure 3.19, phi_o. Boundary: 0 when one stands above the other.
[[nodiscard]] double bearing_from_object_rad(const Eigen::Vector3d& object_in_map,
                                             const Eigen::Vector3d& camera_in_map);

enum class AssociationPolicy {
  /// Ours: all observations of a frame and all objects near them are matched one to one so that the
  /// sum of affinities is largest; then objects whose points overlap are merged.
  kAssignment,
  /// [hypermap] 3.4.5: same class and Jaccard index of the shapes above a threshold.
  kOverlap,
  /// [hypermap] 3.4.5: same class and bounds that meet a square around the observation's centroid,
  /// from above.
  kRadius,
  /// [smap] 3.5.4: at a vertex near the sensor's, same label, in the active cone, nearer than o_e
  /// o_t; the nearest.
  kSmap,
};

/// Policies `kOverlap` and `kRadius`: what becomes of several objects that an observation matches.
/// Source: [hypermap] 3.4.5.
enum class SeveralMatches : std::uint8_t {
  kCombine,    ///< They become one.
  kKeepApart,  ///< Each is updated; the observation's voxels are of the one that came first.
};

/// Policy `kAssignment`. All of it is ours; docs/RESULTS.md has the comparison with the sources.
///
/// The overlap of two point sets is described by: the share of the points of each that lie within
/// `near_m` of the other, the share of the smaller box that lies in the other, the distance of the
/// centres in mean box diagonals, and the agreement of the class vectors.
struct AssignmentOptions {
  /// Points and boxes this near touch. Unit: metre.
  double near_m = 0.025;
  /// Class vectors that agree at least so much count as the same class.
  double same_class_agreement = 0.3;
  /// Same class: share of the points of one that must lie in the other, ...
  double same_class_share = 0.25;
  /// ... or share of the smaller box, ...
  double same_class_box_share = 0.4;
  /// ... or the most distance of the centres in mean diagonals.
  double same_class_distance = 0.3;
  /// Other class: share of the points of each that must lie in the other, ...
  double other_class_share = 0.45;
  /// ... or nearly all of one lies in the other ...
  double part_share = 0.8;
  /// ... and its diagonal is at least this share of the other's: a cup is no part of a table.
  double part_diagonal = 0.5;
  /// ... and it was not seen more than this many times as often: a false alarm around a keyboard
  /// does not swallow it.
  double part_maturity = 3.0;
  /// Objects are merged when the shares above are exceeded by this factor.
  double merge_factor = 1.15;
  /// But not when they were detected beside each other in so many frames, ...
  std::uint32_t apart_frames = 2;
  /// ... unless each has this share of its points in the other: one surface. Or they are parts of
  /// one, below.
  double one_surface_share = 0.6;
  /// Two real objects of one class that touch and were detected so often each are parts of one when
  /// they were hardly ever in view together: the faces of a box, the back and the seat of a chair
  /// under a table. Things that stand side by side come into view together. Or when both were in
  /// view, most of each, and were detected in turn: in less than 0.3 of the frames that two things
  /// would share by chance, of which there are six or more; and the larger one holds most of the
  /// box around both. The few frames that detect both do not keep such apart. 0: never; fewer than
  /// 4 ask for as many fewer frames in which one of them was in view beside the other.
  std::uint32_t hidden_part_detections = 4;
  /// Of two observations in one frame that might show the same object, the lesser one shows another
  /// object when neither has more than this share of its points in the other.
  double apart_share = 0.3;
  /// A cell that two objects claim goes to the one whose observations agree on it so many times
  /// more.
  double contested_factor = 1.5;
  friend bool operator==(const AssignmentOptions&, const AssignmentOptions&) = default;
};
[[nodiscard]] const OptionTable& option_table(const AssignmentOptions& options);

enum class BoxCarvingRule : std::uint8_t {
  kNone,               ///< Boxes only tell where to look for points.
  kBoxes,              ///< A cell that is seen outside the box loses a vote.
  kBoxesAndBackground  ///< And one that is seen on a surface which runs on beyond the box.
};

/// What a frame shows beside what a detection means: `carve_by_boxes`, box_carving.hpp.
struct BoxCarvingOptions {
  BoxCarvingRule rule = BoxCarvingRule::kBoxesAndBackground;
  /// A box reaches farther by this share of its width or height on each side: detectors' boxes are
  /// not exact.
  double margin_share = 0.1;
  /// A box that leaves out more than this share of what is seen of the object shows a part of it,
  /// and speaks against nothing.
  double max_share = 0.1;
  friend bool operator==(const BoxCarvingOptions&, const BoxCarvingOptions&) = default;
};

[[nodiscard]] const OptionTable& option_table(const BoxCarvingOptions& options);

struct AssociationOptions {
  AssociationPolicy policy = AssociationPolicy::kAssignment;
  AssignmentOptions assignment = {};
  double min_jaccard = 0.2;                                   ///< Policy overlap. No unit.
  double radius_m = 0.5;                                      ///< Policy radius: half side. Metre.
  SeveralMatches several_matches = SeveralMatches::kCombine;  ///< Policies overlap and radius.
  double position_error_m = 0.2;                              ///< Policy smap, o_e. Metre.
  double tracking_factor = 0.5;                               ///< Policy smap, o_t. No unit.
  /// Policy smap: candidates are at vertices of the topological map that at most so many edges lie
  /// between the sensor's and; none: anywhere.                            [smap] 3.5.4, step 1
  std::optional<int> graph_layers = 3;
  /// Which shape of an object policy overlap compares with.
  ShapePolicy shape = ShapePolicy::kBest;
  double shape_leaf_m = 0.03;  ///< Thins projected points. Metre.
  /// The box follows the agreed points (ours) instead of the filter of [smap] Eq. (3.20).
  bool box_from_points = true;
  double max_box_confidence = 0.85;  ///< A certain box would freeze the object.
  double min_gain = 0.05;          ///< Smallest gain of the box filter: a moved object can follow.
  LogOdds max_box_log_odds{10.0};  ///< Clamp of l_c.
  LogOdds new_existence{1.0};      ///< Of a new object.
  LogOdds seen_existence{1.0};     ///< Added by each observation.
  LogOdds max_existence{20.0};     ///< Cap.
  /// Bounds of 30 instead of 10: two confident errors shall not overturn sixty observations.
  ClassBeliefOptions belief = {.max_log_odds = LogOdds{30.0}, .min_log_odds = LogOdds{-30.0}};
  VisibilityHistogramOptions histogram = {};
  OccupancyVotesOptions points = {};
  BoxCarvingOptions carving = {};
  /// Their observations update no object (a person walks by).
  std::vector<ClassId> transient_classes = {};

  friend bool operator==(const AssociationOptions&, const AssociationOptions&) = default;
};

/// Errors: kInvalidArgument naming the first field out of its range.
[[nodiscard]] Result<void> validate(const AssociationOptions& options);
[[nodiscard]] const OptionTable& option_table(const AssociationOptions& options);

/// The same options with `hidden_part_detections` 0: for observations beside which nobody notes
/// what was in view and not detected.
[[nodiscard]] AssociationOptions without_hidden_parts(AssociationOptions options);

/// Two objects became one.
struct ObjectMerge {
  ObjectId from;
  ObjectId into;
  friend bool operator==(const ObjectMerge&, const ObjectMerge&) = default;
};

struct AssociationReport {
  /// Per observation; kNoObject for those of transient classes and without a shape. Merges are
  /// applied.
  std::vector<ObjectId> object_of_observation;
  std::vector<ObjectId> created;    ///< Ascending.
  std::vector<ObjectId> matched;    ///< Ascending, each once.
  std::vector<ObjectMerge> merged;  ///< In the order in which they happened.
  std::size_t num_transient = 0;    ///< Of a transient class.
  /// Of an object that this frame had shown already; they update nothing.
  std::size_t num_repeated = 0;
  std::size_t num_without_shape = 0;  ///< Policies overlap and radius: the points span no area.
};

/// Positive association: matches observations of one frame with objects, updates those, creates new
/// ones, merges duplicates.
///
/// `scope` limits the candidates of policy smap.
/// Requires: validate(options); observations have points and class scores.
/// Boundary: observations of equal affinity go in their order; the result is the same on every run.
/// Cost: O(n^3) in the observations of a connected group, else linear in points.
AssociationReport associate(ObjectMap& objects,
                            std::span<const Observation> observations,
                            const AssociationOptions& options,
                            const ObjectScope& scope = {});

/// Updates an object by one observation: class (3.17, 3.18), histogram (3.13), box (3.20, 3.21),
/// shapes, points, embeddings, existence, observation log. Source: [smap] 3.5.3; [hypermap] 3.4.5.
void update_object(Object& object,
                   const Observation& observation,
                   const AssociationOptions& options);

/// A new object from its first observation. Its id is kNoObject until it is in a map.
[[nodiscard]] Object make_object(const Observation& observation, const AssociationOptions& options);

}  // namespace hypermap
