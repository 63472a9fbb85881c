// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/association.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

/// Every fourth pixel each way outlines what a frame shows.
constexpr int kHullStridePx = 4;

VisibilityResult visibility_result_of(const Object& object, const Eigen::Vector3d& camera_in_map) {
  VisibilityResult result;
  result.object = object.id;
  result.bearing_rad = bearing_from_object_rad(object.centroid_in_map, camera_in_map);
  result.distance_m = (object.centroid_in_map - camera_in_map).norm();
  return result;
}

/// From above, what the frame shows; not the camera.
std::vector<Eigen::Vector2d> seen_from_above(const RgbdFrame& frame, double max_range_m) {
  std::vector<Eigen::Vector2d> points;
  for (int v = 0; v < frame.depth_m.height_px(); v += kHullStridePx) {
    for (int u = 0; u < frame.depth_m.width_px(); u += kHullStridePx) {
      const auto depth = static_cast<double>(frame.depth_m.at(u, v));
      if (!(depth > 0.0 && depth <= max_range_m)) continue;
      const PointInCamera seen = frame.camera.unproject(u, v, depth);
      points.emplace_back((frame.map_from_camera * seen).xyz.head<2>());
    }
  }
  return points;
}

/// How many corners' panels lie where. Source: [smap] figure 3.24, p_be, p_in, p_af.
struct PanelCounts {
  int before = 0;
  int inside = 0;
  int after = 0;
  [[nodiscard]] int all() const { return before + inside + after; }
};

/// Steps 3, 5 and 6 of [smap] figure 3.23.
PanelCounts count_panels(const Object& object, const BinnedDepthMap& depth, double tolerance_m) {
  const Box with_tolerance{object.box.min_in_map.array() - tolerance_m,
                           object.box.max_in_map.array() + tolerance_m};
  const double object_distance_m = (object.box.centre() - depth.camera_centre().xyz).norm();
  PanelCounts counts;
  for (const Eigen::Vector3d& corner : object.box.corners()) {
    const DepthPanel* panel = depth.panel_towards({corner});
    if (panel == nullptr || panel->num_points == 0) continue;
    if (panel->box.intersects(with_tolerance)) {
      ++counts.inside;
    } else if (0.5 * (panel->nearest_m + panel->farthest_m) < object_distance_m) {
      ++counts.before;
    } else {
      ++counts.after;
    }
  }
  return counts;
}

/// C.2 of [smap] figure 3.23, whose thresholds the text does not give.
Visibility state_of(const PanelCounts& counts, const AbsenceOptions& options) {
  const double all = counts.all();
  if (counts.all() == 0) return Visibility::kOutOfView;
  if (counts.after > options.absent_share * all) return Visibility::kAbsent;
  if (counts.before > options.occluded_share * all) return Visibility::kOccluded;
  return counts.before > 0 ? Visibility::kPartlyOccluded : Visibility::kVisible;
}

}  // namespace

Result<std::vector<VisibilityResult>> evaluate_visibility_by_hull(const ObjectMap& objects,
                                                                  const RgbdFrame& frame,
                                                                  double max_range_m) {
  const auto area = convex_hull(seen_from_above(frame, max_range_m));
  if (!area) return fail(ErrorCode::kNotFound, "the frame shows no area");
  std::vector<VisibilityResult> results;
  for (const ObjectId id : objects.query(bounds(*area))) {
    const Object& object = objects.at(id);
    if (!contains(*area, object.centroid_in_map.head<2>())) continue;
    VisibilityResult result = visibility_result_of(object, frame.map_from_camera.origin().xyz);
    result.state = Visibility::kVisible;
    result.visible_fraction = 1.0;
    results.push_back(result);
  }
  return results;
}

std::vector<VisibilityResult> evaluate_visibility_by_panels(const ObjectMap& objects,
                                                            const BinnedDepthMap& depth,
                                                            const AbsenceOptions& options) {
  std::vector<VisibilityResult> results;
  for (const Object& object : objects.objects()) {
    const PanelCounts counts = count_panels(object, depth, options.panel_tolerance_m);
    if (counts.all() == 0) continue;
    VisibilityResult result = visibility_result_of(object, depth.camera_centre().xyz);
    result.state = state_of(counts, options);
    result.visible_fraction = static_cast<double>(counts.inside) / counts.all();
    result.absent_fraction = static_cast<double>(counts.after) / counts.all();
    results.push_back(result);
  }
  return results;
}

}  // namespace hypermap
