// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include "hypermap/core/objects/box_carving.hpp"
#include "hypermap/core/objects/object_looks.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/core/segmentation/stacking.hpp"
#include "hypermap/octree_semantic/octree/floor_surface.hpp"
#include "integration/frame_checks.hpp"
#include "mapper/borrowed_frames.hpp"
#include "mapper/frame_observations.hpp"
#include "mapper/object_scopes.hpp"
#include "mapper/observation_labels.hpp"
#include "mapper/snapshot_exchange.hpp"
#include "mapper/topological_growth.hpp"
#include "mapper/transient_observations.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hypermap {
namespace {

/// Requires: the range is set (`with_ranges`).
SegmentedDepth segmented_depth(const GeometricSegmentationOptions& options) {
  return {.min_m = options.min_range_m, .max_m = *options.max_range_m};
}

/// Hidden parts are told by missed detections: not where those are not noted.
AssociationOptions association_options(const SemanticMapperOptions& options) {
  const AbsenceOptions& absence = options.objects.absence;
  const bool notes_misses = options.deadline.rule == DeadlineRule::kNone &&
                            absence.missed_decay.value() > 0.0 && absence.unseen_side_factor > 0.0;
  return notes_misses ? options.objects.association
                      : without_hidden_parts(options.objects.association);
}

}  // namespace

Result<SemanticMapper> SemanticMapper::create(const SemanticMapperOptions& options,
                                              const ClassRegistry& classes) {
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree octree, SemanticOctree::create(options.octree));
  return resume(options, std::move(octree), ObjectMap{}, classes);
}

Result<SemanticMapper> SemanticMapper::resume(const SemanticMapperOptions& options,
                                              SemanticOctree octree,
                                              ObjectMap objects,
                                              const ClassRegistry& classes,
                                              std::optional<TopologicalMap> topological_map) {
  HYPERMAP_TRY(validate(options));
  if (octree.options() != options.octree) {
    return fail(ErrorCode::kInvalidArgument,
                "the map to go on from has other options of the octree (resolution " +
                    std::to_string(octree.resolution_m()) + " m)",
                "octree");
  }
  HYPERMAP_ASSIGN_OR_RETURN(TopologicalMap places,
                            topological_map_of(std::move(topological_map), options.places));
  HYPERMAP_ASSIGN_OR_RETURN(ClassFilter filter, ClassFilter::create(options, classes));
  HYPERMAP_ASSIGN_OR_RETURN(EmbeddingDimensions dimensions, embedding_dimensions(objects));
  HYPERMAP_ASSIGN_OR_RETURN(OcclusionScene occlusion, OcclusionScene::create());
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree empty, SemanticOctree::create(options.octree));
  try {
    auto known = std::make_shared<const ClassRegistry>(classes);
    auto nothing = std::make_shared<const MapSnapshot>(MapSnapshot{
        std::move(empty), ObjectMap{}, TopologicalMap(options.places), known, 0, 0, {}});
    SemanticMapper mapper(options,
                          std::move(filter),
                          std::move(octree),
                          std::move(objects),
                          std::move(places),
                          std::move(occlusion),
                          std::move(known),
                          std::make_unique<SnapshotExchange>(std::move(nothing)));
    mapper.find_voxels_of_objects();
    mapper.embedding_dimensions_ = std::move(dimensions);
    if (options.publish_every_n_frames > 0) mapper.publish();
    return mapper;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for a mapper");
  }
}

SemanticMapper::SemanticMapper(SemanticMapperOptions options,
                               ClassFilter class_filter,
                               SemanticOctree octree,
                               ObjectMap objects,
                               TopologicalMap topological_map,
                               OcclusionScene occlusion,
                               std::shared_ptr<const ClassRegistry> classes,
                               std::unique_ptr<SnapshotExchange> snapshots)
    : options_(with_ranges(std::move(options))),
      class_filter_(std::move(class_filter)),
      octree_(std::move(octree)),
      objects_(std::move(objects)),
      topological_map_(std::move(topological_map)),
      occlusion_(std::move(occlusion)),
      smoother_(options_.smoothing),
      refiner_(options_.refinement),
      classes_(std::move(classes)),
      snapshots_(std::move(snapshots)) {
  options_.integration.num_threads = options_.num_threads;
}

SemanticMapper::SemanticMapper(SemanticMapper&&) noexcept = default;
SemanticMapper& SemanticMapper::operator=(SemanticMapper&&) noexcept = default;
SemanticMapper::~SemanticMapper() = default;

Result<FrameReport> SemanticMapper::integrate(const RgbdFrame& frame, DetectorLook look) {
  try {
    return integrate_or_throw(frame, look);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "out of memory");
  }
}

Result<FrameReport> SemanticMapper::integrate_or_throw(const RgbdFrame& given, DetectorLook look) {
  StopWatch watch(clock_);
  HYPERMAP_TRY(check(given));
  RgbdFrame frame = with_depth(given, smoothed_depth(given));
  const double smooth_s = watch.lap();
  if (!frame.floor_height_m && !given.detections.empty())
    frame.floor_height_m = floor_below_m(octree_, frame.map_from_camera.origin());
  auto report = options_.refinement.rule == PoseRefinementRule::kNone
                    ? integrate_at_pose(frame, given.detections, look, watch)
                    : integrate_refined(frame, given.detections, look, watch);
  if (report) report->seconds.smooth = smooth_s;
  return report;
}

Result<FrameReport> SemanticMapper::integrate_at_pose(const RgbdFrame& frame,
                                                      std::span<const Detection> given_detections,
                                                      DetectorLook look,
                                                      StopWatch& watch) {
  FrameReport report;
  report.map_from_camera = frame.map_from_camera;
  apply_pending_relabels();  // what an earlier frame left to be done
  HYPERMAP_ASSIGN_OR_RETURN(auto dimensions,
                            with_embeddings_of(given_detections, embedding_dimensions_));
  HYPERMAP_ASSIGN_OR_RETURN(
      auto detections,
      stack_detections(given_detections, options_.objects.stacking, stacking_model_));
  report.num_detections = detections.size();
  const auto num_accepted = static_cast<std::size_t>(std::ranges::count_if(
      detections, [this](const Detection& d) { return class_filter_.accepts(d.class_scores); }));
  report.num_transient = report.num_detections - num_accepted;
  // What is transient is segmented, too: it is no other detection's object, and no surface.
  std::erase_if(detections, [this](const Detection& d) {
    return !class_filter_.accepts(d.class_scores) && !class_filter_.is_transient(d.class_scores);
  });

  const double deadline = deadline_s(options_.deadline, num_accepted);
  const auto in_time = [&] { return watch.elapsed_s() < deadline; };
  const bool is_limited = options_.deadline.rule != DeadlineRule::kNone;
  auto [observations, without_segment, not_begun] =
      observe(frame, detections, options_, is_limited ? MayBegin(in_time) : MayBegin());
  const TransientDetections transient{.observations = take_transient(observations),
                                      .without_segment = take_transient(without_segment),
                                      .not_begun = take_transient(not_begun)};
  report.num_deadline_dropped = not_begun.size();
  report.num_segments = observations.size();
  inform(observations);
  report.seconds.segment = watch.lap();

  ObjectMap objects = objects_;
  const auto association =
      associate(objects,
                observations,
                association_options(options_),
                scope_of_candidates(frame, topological_map_, options_.objects));
  look_at_matched(objects, frame, observations, association, options_.objects.association);
  carve_by_boxes(objects, frame, observations, association, options_.objects.association);
  report.num_created = association.created.size();
  report.num_matched = association.matched.size();
  report.num_merged = association.merged.size();
  report.detected = detected_objects(observations, association);
  report.merged = association.merged;
  report.seconds.associate = watch.lap();

  const auto labels = observation_labels(std::move(observations), association);
  prepare_to_adopt(labels, association.merged);
  const StillFrame still =
      transient.empty()
          ? StillFrame{with_depth(frame, borrowed(frame.depth_m))}
          : without_transient(frame, transient, segmented_depth(options_.objects.segmentation));
  HYPERMAP_ASSIGN_OR_RETURN(
      report.integration,
      integrator_.integrate(octree_, still.frame, labels, options_.integration));
  report.integration.num_not_measured -= still.num_left_out;
  report.integration.num_transient = still.num_left_out;
  // Invariant: from here on the frame is in the map.
  adopt(std::move(objects), labels, association.merged);
  embedding_dimensions_ = std::move(dimensions);
  note_frame(frame.index, frame.stamp);
  report.seconds.integrate = watch.lap();

  apply_missed_detections(frame, association, look, report);
  report.seconds.visibility = watch.lap();
  report.published = publish_if_due();
  return report;
}

void SemanticMapper::note_frame(std::uint64_t index, Stamp stamp) noexcept {
  ++num_frames_;
  frame_index_ = index;
  stamp_ = stamp;
}

Result<void> SemanticMapper::set_classes(const ClassRegistry& classes) {
  if (classes == *classes_) return {};
  try {
    HYPERMAP_ASSIGN_OR_RETURN(ClassFilter filter, ClassFilter::create(options_, classes));
    classes_ = std::make_shared<const ClassRegistry>(classes);
    class_filter_ = std::move(filter);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the names of classes");
  }
  return {};
}

Result<void> SemanticMapper::check(const RgbdFrame& frame) const {
  HYPERMAP_TRY(validate(frame));
  return check_sensor(octree_.grid(), frame.map_from_camera.origin(), "map_from_camera");
}

/// Invariant: on any failure the frame is in the map and the objects are unchanged.
void SemanticMapper::apply_missed_detections(const RgbdFrame& frame,
                                             const AssociationReport& association,
                                             DetectorLook look,
                                             FrameReport& report) {
  try {
    apply_pending_relabels();
    grow_topological_map(frame.map_from_camera.origin(), association);
    if (look == DetectorLook::kNotLooked || report.num_deadline_dropped > 0) return;
    const std::vector<ObjectId> detected = ids_of_detected(association);
    const auto results = evaluate_objects(frame, detected);
    if (!results) return;
    ObjectMap objects = objects_;
    const AbsenceReport absences = apply_absences(
        objects, *results, options_.objects.absence, detected, frame.index, frame.stamp);
    pending_relabels_.reserve(absences.removed.size());
    report.num_removed = absences.removed.size();
    report.visibility_evaluated = true;
    objects_ = std::move(objects);
    for (const ObjectId id : absences.removed) {
      pending_relabels_.push_back({id, kNoObject, take_voxel_bounds(id)});
    }
    apply_pending_relabels();
  } catch (const std::bad_alloc&) {
    return;  // the next frame goes on with `pending_relabels_`
  }
}

Result<std::vector<VisibilityResult>> SemanticMapper::evaluate_objects(
    const RgbdFrame& frame, std::span<const ObjectId> detected) {
  const double max_range_m = options_.integration.max_range_m;
  switch (options_.objects.absence.policy) {
    case VisibilityPolicy::kHull: {
      auto results = evaluate_visibility_by_hull(objects_, frame, max_range_m);
      // A frame without any area has no visible area: nothing is weakened.
      if (!results && results.error().code == ErrorCode::kNotFound) return {};
      return results;
    }
    case VisibilityPolicy::kPanels: {
      const auto panels =
          BinnedDepthMap::create(frame, options_.objects.binned_depth, options_.num_threads);
      return evaluate_visibility_by_panels(
          objects_,
          panels,
          options_.objects.absence,
          scope_of_absences(frame, topological_map_, options_.objects));
    }
    case VisibilityPolicy::kRays:
      break;
  }
  const auto query = [&](std::span<const OcclusionRay> rays) -> Result<std::vector<std::uint8_t>> {
    HYPERMAP_TRY(occlusion_.update(octree_, options_.num_threads));
    return occlusion_.occluded(rays, options_.num_threads);
  };
  return evaluate_visibility(objects_, frame, query, options_.visibility, detected);
}

}  // namespace hypermap
