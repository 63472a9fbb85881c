// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From frames with detections to a labelled octree and the objects that stand in it.
///
/// Source: [smap] figure 3.1; [hypermap] 3.4, figure 8.
/// Long because: one class, its options and its report, with what each call promises.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/deadline.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/cloud_observations.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "hypermap/core/places/place_prior.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/core/registration/pose_refinement.hpp"
#include "hypermap/core/registration/pose_refiner.hpp"
#include "hypermap/core/segmentation/depth_smoothing.hpp"
#include "hypermap/core/segmentation/labelled_cloud.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "hypermap/octree_semantic/mapper/map_snapshot.hpp"
#include "hypermap/octree_semantic/occlusion/object_visibility.hpp"
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hypermap {

struct OptionTable;

/// `integration.max_range_m` is the range of the whole map: `visibility`, `objects.segmentation`
/// (up to kMaxSegmentedRangeM) and `objects.binned_depth` follow it where they say no other.
struct SemanticMapperOptions {
  OctreeOptions octree = {};
  IntegrationOptions integration = {};
  CloudOptions cloud = {};  ///< Of integrate_cloud.
  ObjectPipelineOptions objects = {};
  VisibilityOptions visibility = {};
  /// Bounds the work on a frame, for live use; off to begin with.
  DeadlineOptions deadline = {};
  /// Takes noise out of the depth of frames before anything else looks at it.
  DepthSmoothingOptions smoothing = {};
  /// Mends given poses of frames by the surfaces that earlier frames showed; off to begin with.
  PoseRefinementOptions refinement = {};
  /// Of the topological map, which grows with the sensor's way and toward objects.
  TopologicalMapOptions places = {};
  /// Of what is known of classes besides detections; set_prior_source has it.
  PlacePriorOptions prior = {};
  /// Names of the only classes whose pixels reach voxels and objects; empty: all. Classes that do
  /// not stay are named in `objects.transient_class_names`.
  std::vector<std::string> wanted_class_names = {};
  /// Threads for the detections of a frame and for rays. The result does not depend on it.
  int num_threads = 1;
  /// A snapshot for other threads is published when so many frames were integrated since the last
  /// one, 0 .. 1,000,000; 0: never, and nothing is paid for it.
  int publish_every_n_frames = 0;
  friend bool operator==(const SemanticMapperOptions&, const SemanticMapperOptions&) = default;
};
/// The same with every range set: those that follow are the map's.
[[nodiscard]] SemanticMapperOptions with_ranges(SemanticMapperOptions options);

/// Errors: kInvalidArgument naming the field, ranges that follow included.
[[nodiscard]] Result<void> validate(const SemanticMapperOptions& options);
[[nodiscard]] const OptionTable& option_table(const SemanticMapperOptions& options);

/// Time of one frame's stages, by the mapper's clock. For reports only: no result depends on it.
struct StageSeconds {
  double smooth = 0.0;
  double refine = 0.0;
  double segment = 0.0;
  double associate = 0.0;
  double integrate = 0.0;
  double visibility = 0.0;
};

/// An object that a frame showed.
struct DetectedObject {
  ObjectId id;
  PixelBox box_px;             ///< Around the detection's box and mask.
  std::size_t num_pixels = 0;  ///< Of its segment: those of the object that nothing hides.
  Probability score;           ///< Of the detection.
};

/// Whether a detector looked at a frame.
enum class DetectorLook {
  kLooked,
  kNotLooked,  ///< That it names no object says nothing: none is missed.
};

/// What became of one frame.
struct FrameReport {
  std::size_t num_detections = 0;  ///< After stacking.
  /// Of a class that does not stay or is not wanted.
  std::size_t num_transient = 0;
  std::size_t num_segments = 0;  ///< Detections that were found in the depth.
  /// Detections dropped by the deadline, those of the lowest scores; of classes that stay.
  std::size_t num_deadline_dropped = 0;
  std::size_t num_created = 0;
  std::size_t num_matched = 0;
  std::size_t num_merged = 0;   ///< Duplicates merged into another object.
  std::size_t num_removed = 0;  ///< Objects that proved absent.
  /// A detection each that is of an object now, in the order of the detections; of a scan none.
  std::vector<DetectedObject> detected;
  /// In the order in which they happened.
  std::vector<ObjectMerge> merged;
  /// False when visibility was not evaluated: no detector looked or such detections were dropped,
  /// so that a missed detection means nothing, or there was no memory or no Embree for it.
  bool visibility_evaluated = false;
  /// Whether the frame is in a snapshot now. When memory ends before it is, the next frame tries.
  bool published = false;
  PoseCorrection pose;            ///< What became of the given pose.
  MapFromCamera map_from_camera;  ///< Where the frame stands in the map.
  IntegrationReport integration;
  StageSeconds seconds;
};

class SnapshotExchange;

/// The whole map in the making. Movable, not copyable; `octree()` and `objects()` are values.
///
/// Threads: one `integrate` at a time; `snapshot` at any time from any thread; the other const
/// functions may run concurrently between two calls of `integrate`.
class SemanticMapper {
 public:
  SemanticMapper(const SemanticMapper&) = delete;
  SemanticMapper& operator=(const SemanticMapper&) = delete;
  SemanticMapper(SemanticMapper&&) noexcept;
  SemanticMapper& operator=(SemanticMapper&&) noexcept;
  ~SemanticMapper();

  /// `classes`: what the ids of detections mean; it may grow later, see set_classes.
  /// Errors: those of validate; kNotFound when `classes` does not know a name that the options
  /// give (`transient_names`); kUnavailable when Embree cannot start; kOutOfMemory.
  [[nodiscard]] static Result<SemanticMapper> create(const SemanticMapperOptions& options,
                                                     const ClassRegistry& classes = {});
  /// Goes on from a map that was made before, which is the first snapshot when any are published.
  /// Voxels that bear an id of no object are freed of it.
  /// Errors: those of create; kInvalidArgument when the tree's options are not those of
  /// `options.octree`, or the topological map's not `options.places`; objects whose embeddings of
  /// one model differ in their dimension. Boundary: no topological map, as of a map that was made
  /// without: one is begun, and made toward all objects that there are.
  [[nodiscard]] static Result<SemanticMapper> resume(
      const SemanticMapperOptions& options,
      SemanticOctree octree,
      ObjectMap objects,
      const ClassRegistry& classes = {},
      std::optional<TopologicalMap> topological_map = std::nullopt);

  /// Puts one frame into the map: whole, or on an error not at all. With `refinement` it stands in
  /// the map at its refined pose, for everything that is learnt from it: by the surfaces of frames
  /// that this mapper was given before. One that waits for later frames is posed by PoseRefiner and
  /// PoseSmoother instead, and given here without `refinement`.
  ///
  /// Errors: those of validate(frame), stack_detections and FrameIntegrator::integrate;
  /// kInvalidArgument for an embedding of another dimension than its model's have so far. A
  /// detection that cannot be found in the depth is counted, no error. Objects are updated on a
  /// copy that takes their place when the octree has the frame; should memory end after that, what
  /// is left of the frame's work waits for the next one, see `FrameReport::visibility_evaluated`.
  /// A frame at which no detector looked brings its surfaces and free space; no object is missed.
  [[nodiscard]] Result<FrameReport> integrate(const RgbdFrame& frame,
                                              DetectorLook look = DetectorLook::kLooked);

  /// Puts one scan into the map: whole, or on an error not at all. Its pose is used as given, and
  /// no frame is refined by it. Instances meet the objects as
  /// detections do; points of a class alone label voxels. Visibility is not evaluated: what a scan
  /// does not show is no missed detection.
  ///
  /// Errors: those of validate(cloud) and FrameIntegrator::integrate_far_cloud.
  [[nodiscard]] Result<FrameReport> integrate_cloud(const LabelledCloud& cloud);

  /// Whom each observation's class is asked of besides its detection, from the next frame on; null,
  /// as to begin with: nobody. `options().prior` makes none by itself.
  void set_prior_source(std::shared_ptr<const ClassPriorSource> source) {
    prior_source_ = std::move(source);
  }

  /// What stages are timed by and deadlines kept by; the wall clock to begin with. Requires: not
  /// empty.
  void set_clock(Clock clock) { clock_ = std::move(clock); }

  /// What `objects.stacking` needs to know of the detectors: weights that its options name. Until
  /// it is set all weights are 1. Threads: as `integrate`.
  void set_stacking_model(StackingModel model) { stacking_model_ = std::move(model); }

  /// Which classes the ids of detections stand for: what snapshots say from the next one on. The
  /// mapper keeps a copy, so the registry of the caller may grow at any other time.
  ///
  /// Errors: kNotFound as `create`; kOutOfMemory. Cost: a comparison of the names; a copy of them
  /// when there are new ones.
  /// Threads: as `integrate`.
  [[nodiscard]] Result<void> set_classes(const ClassRegistry& classes);

  /// 1 on the pixels that detections of transient classes may show, which are no surface to refine
  /// a pose by; empty without such detections. Requires: validate(frame) of what they are of.
  /// Cost: O(pixels) for each of them. Throws std::bad_alloc.
  [[nodiscard]] MaskImage transient_pixels(const PinholeCamera& camera,
                                           std::span<const Detection> detections) const;

  /// The newest snapshot that was published: octree, objects, topological map and classes between
  /// two frames. Never null; an empty map before the first.
  ///
  /// Cost: a pointer is copied, at any size of the map; no wait for a frame.
  /// Threads: from any thread, also while `integrate` runs, but not while the mapper is moved from
  /// or destroyed. The snapshot may outlive the mapper.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> snapshot() const;

  [[nodiscard]] const SemanticOctree& octree() const noexcept { return octree_; }
  [[nodiscard]] const ObjectMap& objects() const noexcept { return objects_; }
  /// The places that the sensor came to and those made toward objects; see object_vertices.hpp for
  /// which object belongs to which. Source: [smap] 3.5.1.
  [[nodiscard]] const TopologicalMap& topological_map() const noexcept { return topological_map_; }
  /// As given, with the ranges that follow filled in.
  [[nodiscard]] const SemanticMapperOptions& options() const noexcept { return options_; }

 private:
  /// Which classes reach the map.
  struct ClassFilter {
    std::vector<ClassId> transient;  ///< Ascending; none that is wanted by name.
    std::vector<ClassId> wanted;     ///< Ascending; none: all.
    /// Of the names that the options give. Errors: as asked_classes, naming the field.
    [[nodiscard]] static Result<ClassFilter> create(const SemanticMapperOptions& options,
                                                    const ClassRegistry& classes);
    [[nodiscard]] bool accepts(std::span<const ClassEvidence> class_scores) const;
    [[nodiscard]] bool is_transient(std::span<const ClassEvidence> class_scores) const;
  };
  SemanticMapper(SemanticMapperOptions options,
                 ClassFilter class_filter,
                 SemanticOctree octree,
                 ObjectMap objects,
                 TopologicalMap topological_map,
                 OcclusionScene occlusion,
                 std::shared_ptr<const ClassRegistry> classes,
                 std::unique_ptr<SnapshotExchange> snapshots);
  /// Voxels of one object that are to be relabelled to another, or to none.
  struct PendingRelabel {
    ObjectId from;
    ObjectId into;
    Box bounds;
  };
  /// A frame or scan is in the map: what snapshots say of it.
  void note_frame(std::uint64_t index, Stamp stamp) noexcept;
  [[nodiscard]] bool publish_if_due();
  void publish();
  [[nodiscard]] Result<FrameReport> integrate_or_throw(const RgbdFrame& given, DetectorLook look);
  /// The frame's depth without noise; the given one borrowed where that is not asked for.
  [[nodiscard]] DepthImage smoothed_depth(const RgbdFrame& given);
  [[nodiscard]] Result<FrameReport> integrate_refined(const RgbdFrame& frame,
                                                      std::span<const Detection> given_detections,
                                                      DetectorLook look,
                                                      StopWatch& watch);
  [[nodiscard]] Result<FrameReport> integrate_at_pose(const RgbdFrame& frame,
                                                      std::span<const Detection> given_detections,
                                                      DetectorLook look,
                                                      StopWatch& watch);
  [[nodiscard]] Result<void> check(const RgbdFrame& frame) const;
  [[nodiscard]] Result<FrameReport> integrate_cloud_or_throw(const LabelledCloud& cloud);
  /// Makes room for what `adopt` notes. Throws std::bad_alloc.
  void prepare_to_adopt(std::span<const PixelLabels> labels, std::span<const ObjectMerge> merges);
  /// The objects that belong to the octree as it was just written.
  void adopt(ObjectMap objects,
             std::span<const PixelLabels> labels,
             std::span<const ObjectMerge> merges) noexcept;
  /// The sensor came to a place, and objects were created, updated or merged: the topological map
  /// grows to both. Requires: octree and objects have the frame. Throws std::bad_alloc; what is
  /// missing then, the next frame makes as far as it shows it.
  void grow_topological_map(const PointInMap& sensor, const AssociationReport& association);
  /// Tells observations how many classes there are, and what is known of theirs.
  void inform(std::vector<Observation>& observations) const;
  /// Those of transient classes, which are no longer among the others.
  [[nodiscard]] std::vector<Observation> take_transient(
      std::vector<Observation>& observations) const;
  [[nodiscard]] std::vector<const Detection*> take_transient(
      std::vector<const Detection*>& detections) const;
  /// A scan's points, those of transient classes as no measurement. Without such classes none.
  struct StillPoints {
    std::vector<Eigen::Vector3f> in_map;
    std::size_t num_left_out = 0;
  };
  [[nodiscard]] StillPoints still_points(const LabelledCloud& cloud,
                                         const CloudObservations& seen) const;
  void find_voxels_of_objects();
  /// Of an object that `prepare_to_adopt` made room for; else nothing.
  void grow_voxel_bounds(ObjectId id, const Box& by) noexcept;
  /// The bounds of an object's voxels, which are forgotten.
  [[nodiscard]] Box take_voxel_bounds(ObjectId id) noexcept;
  void apply_pending_relabels();
  void apply_missed_detections(const RgbdFrame& frame,
                               const AssociationReport& association,
                               DetectorLook look,
                               FrameReport& report);
  [[nodiscard]] Result<std::vector<VisibilityResult>> evaluate_objects(
      const RgbdFrame& frame, std::span<const ObjectId> detected);

  SemanticMapperOptions options_;
  ClassFilter class_filter_;
  StackingModel stacking_model_;
  SemanticOctree octree_;
  ObjectMap objects_;
  TopologicalMap topological_map_;
  std::shared_ptr<const ClassPriorSource> prior_source_;
  OcclusionScene occlusion_;
  FrameIntegrator integrator_;
  DepthSmoother smoother_;
  PoseRefiner refiner_;
  EmbeddingDimensions embedding_dimensions_;  ///< Of all frames and objects in the map.
  Clock clock_ = wall_clock_s;
  /// A box around all voxels that bear an object's id, perhaps larger: what an id's voxels are
  /// found by when it ends.
  std::unordered_map<ObjectId, Box> voxel_bounds_;
  std::vector<PendingRelabel> pending_relabels_;  ///< In their order; mostly none.
  std::shared_ptr<const ClassRegistry> classes_;  ///< For snapshots; never null.
  std::unique_ptr<SnapshotExchange> snapshots_;
  std::uint64_t num_frames_ = 0;
  std::uint64_t num_published_frames_ = 0;  ///< Of `num_frames_`, those in the newest snapshot.
  std::uint64_t frame_index_ = 0;           ///< Of the newest frame.
  Stamp stamp_;                             ///< Of the newest frame.
};

}  // namespace hypermap
