// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include "hypermap/core/segmentation/binned_depth_map.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/core/segmentation/stacking.hpp"
#include "integration/frame_checks.hpp"
#include "mapper/snapshot_exchange.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hypermap {
namespace {

/// Detections of things that stay.
std::vector<Detection> lasting(std::vector<Detection> detections,
                               const std::set<ClassId>& transient) {
  std::erase_if(detections, [&](const Detection& detection) {
    const auto best = best_class(detection.class_scores);
    return best && transient.contains(best->id);
  });
  return detections;
}

/// Those detections that the depth confirms; counts those that nobody looked at.
std::vector<Observation> observe(const RgbdFrame& frame,
                                 std::span<const Detection> detections,
                                 const SemanticMapperOptions& options,
                                 const MayBegin& may_begin,
                                 FrameReport& report) {
  auto segments =
      segment_all(frame, detections, options.objects.segmentation, options.num_threads, may_begin);
  std::vector<Observation> observations;
  observations.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i]) {
      observations.push_back(make_observation(frame, detections[i], std::move(*segments[i])));
    } else if (segments[i].error().code == ErrorCode::kOutOfMemory) {
      throw std::bad_alloc();
    } else if (segments[i].error().code == ErrorCode::kLimit) {
      ++report.num_deadline_dropped;
    }
  }
  report.num_segments = observations.size();
  return observations;
}

std::vector<PixelLabels> pixel_labels(std::vector<Observation> observations,
                                      const AssociationReport& association) {
  std::vector<PixelLabels> labels;
  labels.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    labels.push_back({.object = association.object_of_observation[i],
                      .class_scores = std::move(observations[i].class_scores),
                      .pixel_indices = std::move(observations[i].segment.pixel_indices)});
  }
  return labels;
}

std::vector<ObjectId> seen_objects(const AssociationReport& association) {
  std::vector<ObjectId> seen = association.object_of_observation;
  std::erase(seen, kNoObject);
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  return seen;
}

/// Where voxels of an object may lie: its box, grown by a voxel and by what segments overhang.
Box label_bounds(const Object& object, double resolution_m) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.5 + resolution_m);
  return {object.box.min_in_map - margin, object.box.max_in_map + margin};
}

}  // namespace

Result<SemanticMapper> SemanticMapper::create(const SemanticMapperOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree octree, SemanticOctree::create(options.octree));
  return resume(options, std::move(octree), ObjectMap{});
}

Result<SemanticMapper> SemanticMapper::resume(const SemanticMapperOptions& options,
                                              SemanticOctree octree,
                                              ObjectMap objects) {
  HYPERMAP_TRY(validate(options));
  if (octree.options() != options.octree) {
    return fail(ErrorCode::kInvalidArgument,
                "the map to go on from has other options of the octree (resolution " +
                    std::to_string(octree.resolution_m()) + " m)",
                "octree");
  }
  HYPERMAP_ASSIGN_OR_RETURN(OcclusionScene occlusion, OcclusionScene::create());
  try {
    const bool publishes = options.publish_every_n_frames > 0;
    auto first = std::make_shared<const MapSnapshot>(
        MapSnapshot{publishes ? octree : SemanticOctree::create(options.octree).value(),
                    publishes ? objects : ObjectMap{},
                    std::make_shared<const ClassRegistry>(),
                    0,
                    0,
                    {}});
    auto snapshots = std::make_unique<SnapshotExchange>(std::move(first));
    return SemanticMapper(
        options, std::move(octree), std::move(objects), std::move(occlusion), std::move(snapshots));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for a mapper");
  }
}

SemanticMapper::SemanticMapper(SemanticMapperOptions options,
                               SemanticOctree octree,
                               ObjectMap objects,
                               OcclusionScene occlusion,
                               std::unique_ptr<SnapshotExchange> snapshots)
    : options_(with_ranges(std::move(options))),
      octree_(std::move(octree)),
      objects_(std::move(objects)),
      occlusion_(std::move(occlusion)),
      snapshots_(std::move(snapshots)) {
  options_.integration.num_threads = options_.num_threads;
}

SemanticMapper::SemanticMapper(SemanticMapper&&) noexcept = default;
SemanticMapper& SemanticMapper::operator=(SemanticMapper&&) noexcept = default;
SemanticMapper::~SemanticMapper() = default;

Result<FrameReport> SemanticMapper::integrate(const RgbdFrame& frame) {
  try {
    return integrate_or_throw(frame);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "out of memory");
  }
}

Result<FrameReport> SemanticMapper::integrate_or_throw(const RgbdFrame& frame) {
  FrameReport report;
  StopWatch watch(clock_);
  HYPERMAP_TRY(check(frame));
  hand_over_voxels();  // what an earlier frame left to be done
  HYPERMAP_ASSIGN_OR_RETURN(auto stacked,
                            stack_detections(frame.detections, options_.objects.stacking));
  report.num_detections = stacked.size();
  const auto detections = lasting(std::move(stacked), options_.transient_classes);
  report.num_transient = report.num_detections - detections.size();

  const double deadline = deadline_s(options_.deadline, detections.size());
  const auto in_time = [&] { return watch.elapsed_s() < deadline; };
  const bool is_limited = options_.deadline.rule != DeadlineRule::kNone;
  auto observations =
      observe(frame, detections, options_, is_limited ? MayBegin(in_time) : MayBegin(), report);
  report.seconds.segment = watch.lap();

  ObjectMap objects = objects_;
  const auto association = associate(objects, observations, options_.objects.association);
  report.num_created = association.created.size();
  report.num_matched = association.matched.size();
  report.num_merged = association.merged.size();
  std::vector<Handover> merged_voxels = handovers(objects, association.merged);
  report.seconds.associate = watch.lap();

  const auto labels = pixel_labels(std::move(observations), association);
  HYPERMAP_ASSIGN_OR_RETURN(report.integration,
                            integrator_.integrate(octree_, frame, labels, options_.integration));
  // From here on the frame is in the map.
  objects_ = std::move(objects);
  handovers_ = std::move(merged_voxels);
  ++num_frames_;
  frame_index_ = frame.index;
  stamp_ = frame.stamp;
  report.seconds.integrate = watch.lap();

  weaken_unseen(frame, association, report);
  report.published = publish_if_due();
  report.seconds.visibility = watch.lap();
  return report;
}

/// Whatever fails here leaves the snapshot before.
bool SemanticMapper::publish_if_due() {
  const auto every = static_cast<std::uint64_t>(options_.publish_every_n_frames);
  if (every == 0 || num_frames_ - num_published_frames_ < every) return false;
  if (!handovers_.empty()) return false;  // some voxels still name an object that is gone
  try {
    snapshots_->publish(std::make_shared<const MapSnapshot>(
        MapSnapshot{octree_, objects_, classes_, num_frames_, frame_index_, stamp_}));
  } catch (const std::bad_alloc&) {
    return false;
  }
  num_published_frames_ = num_frames_;
  return true;
}

std::shared_ptr<const MapSnapshot> SemanticMapper::snapshot() const {
  return snapshots_->newest();
}

Result<void> SemanticMapper::set_classes(const ClassRegistry& classes) {
  if (classes == *classes_) return {};
  try {
    classes_ = std::make_shared<const ClassRegistry>(classes);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the names of classes");
  }
  return {};
}

Result<void> SemanticMapper::check(const RgbdFrame& frame) const {
  HYPERMAP_TRY(validate(frame));
  return check_sensor(octree_.grid(), frame.map_from_camera.origin());
}

std::vector<SemanticMapper::Handover> SemanticMapper::handovers(
    const ObjectMap& objects, std::span<const ObjectMerge> merges) const {
  std::vector<Handover> out;
  for (const auto& [from, into] : merges) {
    const Object* object = objects.find(into);
    if (object == nullptr) continue;
    out.push_back({from, into, label_bounds(*object, octree_.resolution_m())});
  }
  return out;
}

/// In their order, for one may take what another gave. One that fails is tried again: it starts
/// with what is left of its voxels.
void SemanticMapper::hand_over_voxels() {
  while (!handovers_.empty()) {
    const Handover& first = handovers_.front();
    octree_.relabel_object(first.from, first.into, first.bounds);
    handovers_.erase(handovers_.begin());
  }
}

/// Whatever fails here leaves the frame in the map and objects as they are.
void SemanticMapper::weaken_unseen(const RgbdFrame& frame,
                                   const AssociationReport& association,
                                   FrameReport& report) {
  try {
    hand_over_voxels();
    if (report.num_deadline_dropped > 0) return;
    const std::vector<ObjectId> seen_now = seen_objects(association);
    const auto verdicts = judge(frame, seen_now);
    if (!verdicts) return;
    ObjectMap objects = objects_;
    const AbsenceReport absences = apply_absences(
        objects, *verdicts, options_.objects.absence, seen_now, frame.index, frame.stamp);
    std::vector<Handover> freed;
    for (const ObjectId id : absences.removed) {
      const Box bounds = label_bounds(objects_.at(id), octree_.resolution_m());
      freed.push_back({id, kNoObject, bounds});
    }
    report.num_removed = absences.removed.size();
    report.judged = true;
    objects_ = std::move(objects);
    handovers_ = std::move(freed);
    hand_over_voxels();
  } catch (const std::bad_alloc&) {
    return;  // the next frame goes on with what is left of `handovers_`
  }
}

Result<std::vector<VisibilityVerdict>> SemanticMapper::judge(const RgbdFrame& frame,
                                                             std::span<const ObjectId> seen_now) {
  const double max_range_m = options_.integration.max_range_m;
  switch (options_.objects.absence.policy) {
    case VisibilityPolicy::kHull: {
      auto verdicts = judge_by_hull(objects_, frame, max_range_m);
      // A frame without any area has no visible area: nothing is weakened.
      if (!verdicts && verdicts.error().code == ErrorCode::kNotFound) return {};
      return verdicts;
    }
    case VisibilityPolicy::kPanels: {
      const auto panels =
          BinnedDepthMap::create(frame, options_.objects.binned_depth, options_.num_threads);
      return judge_by_panels(objects_, panels, options_.objects.absence);
    }
    case VisibilityPolicy::kRays:
      break;
  }
  const auto answer = [&](std::span<const SightLine> lines) -> Result<std::vector<std::uint8_t>> {
    HYPERMAP_TRY(occlusion_.update(octree_));
    return occlusion_.occluded(lines, options_.num_threads);
  };
  return judge_visibility(objects_, frame, answer, options_.visibility, seen_now);
}

}  // namespace hypermap
