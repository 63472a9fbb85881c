// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_looks.hpp"

#include "hypermap/core/objects/observation_log.hpp"
#include "matched_points.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace hypermap {
namespace {

/// Detections before the newest one from about the bearing of that.
std::uint32_t num_earlier_from(const ObservationLog& log, double bearing_rad) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t with_newest = num_detections_from(log, bearing_rad);
  return static_cast<std::uint32_t>(
      std::min(with_newest - std::min<std::uint64_t>(1, with_newest), kMost));
}

/// Says of points whether nothing is measured before them.
IsInView view_of(const RgbdFrame& frame, double edge_m) {
  return [&frame, edge_m, camera_from_map = frame.map_from_camera.inverse()](
             const Eigen::Vector3d& point_in_map) {
    const PointInCamera point = camera_from_map * PointInMap{point_in_map};
    const auto at = frame.camera.project(point);
    const auto depth_m = at ? measured_depth_m(frame, *at) : std::nullopt;
    return depth_m && *depth_m >= point.xyz.z() - reach_m(edge_m, point.xyz.z());
  };
}

}  // namespace

void look_at_matched(ObjectMap& objects,
                     const RgbdFrame& frame,
                     std::span<const Observation> observations,
                     const AssociationReport& association,
                     const AssociationOptions& options) {
  for (const ObjectId id : association.matched) {
    const auto position = only_observation_of(id, association);
    if (!position) continue;
    const Observation& observation = observations[*position];
    objects.modify(id, [&](Object& object) {
      object.points.look(observation.segment.points_in_map,
                         view_of(frame, object.points.state().edge_m),
                         num_earlier_from(object.observation_log, observation.bearing_rad));
      follow_points(object, options);
    });
  }
}

}  // namespace hypermap
