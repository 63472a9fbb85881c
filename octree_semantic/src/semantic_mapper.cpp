// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/semantic_mapper.hpp"

#include "frame_checks.hpp"
#include "hypermap/core/binned_depth_map.hpp"
#include "hypermap/core/geometric_segmentation.hpp"
#include "hypermap/core/stacking.hpp"

#include <algorithm>
#include <map>
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

/// Those detections that the depth confirms.
std::vector<Observation> observe(const RgbdFrame& frame,
                                 std::span<const Detection> detections,
                                 const SemanticMapperOptions& options) {
  auto segments = segment_all(frame, detections, options.objects.segmentation, options.num_threads);
  std::vector<Observation> observations;
  observations.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!segments[i]) continue;
    observations.push_back(make_observation(frame, detections[i], std::move(*segments[i])));
  }
  return observations;
}

std::vector<PixelLabels> pixel_labels(std::span<const Observation> observations,
                                      const AssociationReport& association) {
  std::vector<PixelLabels> labels;
  labels.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    labels.push_back({.object = association.object_of_observation[i],
                      .class_scores = observations[i].class_scores,
                      .pixel_indices = observations[i].segment.pixel_indices});
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

Result<void> validate(const SemanticMapperOptions& options) {
  HYPERMAP_TRY(validate(options.octree));
  HYPERMAP_TRY(validate(options.integration));
  HYPERMAP_TRY(validate(options.objects));
  HYPERMAP_TRY(validate(options.visibility));
  if (options.num_threads < 1 || options.num_threads > 256) {
    return fail(ErrorCode::kInvalidArgument,
                "must be in 1..256, is " + std::to_string(options.num_threads),
                "num_threads");
  }
  return {};
}

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
  return SemanticMapper(options, std::move(octree), std::move(objects), std::move(occlusion));
}

SemanticMapper::SemanticMapper(SemanticMapperOptions options,
                               SemanticOctree octree,
                               ObjectMap objects,
                               OcclusionScene occlusion)
    : options_(std::move(options)),
      octree_(std::move(octree)),
      objects_(std::move(objects)),
      occlusion_(std::move(occlusion)) {
  options_.integration.num_threads = options_.num_threads;
}

Result<FrameReport> SemanticMapper::integrate(const RgbdFrame& frame) {
  FrameReport report;
  StopWatch watch(clock_);
  HYPERMAP_TRY(check(frame));
  HYPERMAP_ASSIGN_OR_RETURN(auto stacked,
                            stack_detections(frame.detections, options_.objects.stacking));
  report.num_detections = stacked.size();
  const auto detections = lasting(std::move(stacked), options_.transient_classes);
  report.num_transient = report.num_detections - detections.size();

  const auto observations = observe(frame, detections, options_);
  report.num_segments = observations.size();
  report.seconds.segment = watch.lap();

  const auto association = associate(objects_, observations, options_.objects.association);
  report.num_created = association.created.size();
  report.num_matched = association.matched.size();
  report.num_merged = association.merged.size();
  report.seconds.associate = watch.lap();

  HYPERMAP_ASSIGN_OR_RETURN(
      report.integration,
      integrator_.integrate(
          octree_, frame, pixel_labels(observations, association), options_.integration));
  hand_over_voxels(association.merged);
  report.seconds.integrate = watch.lap();

  HYPERMAP_ASSIGN_OR_RETURN(const auto verdicts, judge(frame, association));
  report.num_removed = weaken_absent(frame, verdicts, seen_objects(association));
  report.seconds.visibility = watch.lap();
  return report;
}

Result<void> SemanticMapper::check(const RgbdFrame& frame) const {
  HYPERMAP_TRY(validate(frame));
  return check_sensor(octree_.grid(), frame.map_from_camera.origin());
}

void SemanticMapper::hand_over_voxels(std::span<const ObjectMerge> merges) {
  for (const auto& [from, into] : merges) {
    const Object* object = objects_.find(into);
    if (object == nullptr) continue;
    octree_.relabel_object(from, into, label_bounds(*object, octree_.resolution_m()));
  }
}

Result<std::vector<VisibilityVerdict>> SemanticMapper::judge(const RgbdFrame& frame,
                                                             const AssociationReport& association) {
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
  HYPERMAP_TRY(occlusion_.update(octree_));
  return judge_visibility(
      objects_, frame, occlusion_, options_.visibility, seen_objects(association));
}

std::size_t SemanticMapper::weaken_absent(const RgbdFrame& frame,
                                          std::span<const VisibilityVerdict> verdicts,
                                          std::span<const ObjectId> seen_now) {
  std::map<ObjectId, Box> bounds;
  for (const VisibilityVerdict& verdict : verdicts) {
    const Object* object = objects_.find(verdict.object);
    if (object != nullptr) {
      bounds.emplace(object->id, label_bounds(*object, octree_.resolution_m()));
    }
  }
  const AbsenceReport absences = apply_absences(
      objects_, verdicts, options_.objects.absence, seen_now, frame.index, frame.stamp);
  for (const ObjectId removed : absences.removed) {
    octree_.relabel_object(removed, kNoObject, bounds.at(removed));
  }
  return absences.removed.size();
}

}  // namespace hypermap
