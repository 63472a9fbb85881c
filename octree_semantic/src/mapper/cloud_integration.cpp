// SPDX-License-Identifier: BSD-3-Clause
// A scan's way into the map.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "integration/frame_checks.hpp"
#include "mapper/observation_labels.hpp"

#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

std::vector<PixelLabels> labels_of(const LabelledCloud& cloud,
                                   CloudObservations seen,
                                   const AssociationReport& association) {
  std::vector<PixelLabels> labels = observation_labels(std::move(seen.instances), association);
  labels.reserve(labels.size() + seen.classes.size());
  for (ClassPoints& points : seen.classes) {
    labels.push_back({.object = kNoObject,
                      .class_scores = cloud.class_vectors[points.class_vector],
                      .pixel_indices = std::move(points.point_indices)});
  }
  return labels;
}

}  // namespace

SemanticMapper::StillPoints SemanticMapper::still_points(const LabelledCloud& cloud,
                                                         const CloudObservations& seen) const {
  StillPoints still;
  if (class_filter_.transient.empty()) return still;
  const auto leave_out = [&](std::span<const std::uint32_t> positions) {
    constexpr float kNoMeasurement = std::numeric_limits<float>::quiet_NaN();
    if (still.in_map.empty()) still.in_map = cloud.points_in_map;
    for (const std::uint32_t position : positions) {
      Eigen::Vector3f& point = still.in_map[position];
      if (!point.allFinite()) continue;
      point.setConstant(kNoMeasurement);
      ++still.num_left_out;
    }
  };
  for (const Observation& instance : seen.instances) {
    if (class_filter_.is_transient(instance.class_scores))
      leave_out(instance.segment.pixel_indices);
  }
  for (const ClassPoints& of_class : seen.classes) {
    if (class_filter_.is_transient(cloud.class_vectors[of_class.class_vector]))
      leave_out(of_class.point_indices);
  }
  return still;
}

Result<FrameReport> SemanticMapper::integrate_cloud(const LabelledCloud& cloud) {
  try {
    return integrate_cloud_or_throw(cloud);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "out of memory");
  }
}

Result<FrameReport> SemanticMapper::integrate_cloud_or_throw(const LabelledCloud& cloud) {
  FrameReport report;
  StopWatch watch(clock_);
  HYPERMAP_TRY(validate(cloud));
  HYPERMAP_TRY(check_sensor(octree_.grid(), cloud.sensor, "sensor"));
  apply_pending_relabels();  // what an earlier frame left to be done
  auto seen = observe_cloud(cloud,
                            {.max_range_m = options_.cloud.max_range_m,
                             .leaf_size_m = options_.objects.segmentation.leaf_size_m,
                             .depth_slack_m = options_.objects.segmentation.depth_slack_m});
  report.num_detections = seen.instances.size();
  const StillPoints still = still_points(cloud, seen);
  std::erase_if(seen.instances,
                [this](const Observation& o) { return !class_filter_.accepts(o.class_scores); });
  std::erase_if(seen.classes, [&](const ClassPoints& points) {
    return !class_filter_.accepts(cloud.class_vectors[points.class_vector]);
  });
  inform(seen.instances);
  report.num_segments = seen.instances.size();
  report.num_transient = report.num_detections - report.num_segments;
  report.seconds.segment = watch.lap();

  ObjectMap objects = objects_;
  // A cloud does not say what was in view and not detected.
  const auto association =
      associate(objects, seen.instances, without_hidden_parts(options_.objects.association));
  report.num_created = association.created.size();
  report.num_matched = association.matched.size();
  report.num_merged = association.merged.size();
  report.merged = association.merged;
  report.seconds.associate = watch.lap();

  const auto labels = labels_of(cloud, std::move(seen), association);
  prepare_to_adopt(labels, association.merged);
  const std::span<const Eigen::Vector3f> points_in_map =
      still.num_left_out == 0 ? cloud.points_in_map : still.in_map;
  HYPERMAP_ASSIGN_OR_RETURN(report.integration,
                            integrator_.integrate_far_cloud(
                                octree_, cloud.sensor, points_in_map, labels, options_.cloud));
  report.integration.num_not_finite -= still.num_left_out;
  report.integration.num_transient = still.num_left_out;
  adopt(std::move(objects), labels, association.merged);  // from here on the scan is in the map
  note_frame(cloud.index, cloud.stamp);
  report.seconds.integrate = watch.lap();
  try {
    apply_pending_relabels();
    grow_topological_map(cloud.sensor, association);
  } catch (const std::bad_alloc&) {
    return report;  // the next frame goes on with what is left
  }
  report.published = publish_if_due();
  return report;
}

}  // namespace hypermap
