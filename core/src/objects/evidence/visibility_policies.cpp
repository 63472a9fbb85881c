// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/association.hpp"
#include "objects/scope_query.hpp"
#include "panel_matches.hpp"

#include <algorithm>
#include <cmath>

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

/// C.2 of [smap] figure 3.23, whose thresholds the text does not give.
Visibility state_of(const PanelCounts& counts, const AbsenceOptions& options) {
  const double all = counts.all();
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
                                                            const AbsenceOptions& options,
                                                            const ObjectScope& scope) {
  const PanelMatches panels(depth);
  std::vector<VisibilityResult> results;
  for (const ObjectId id : objects_in(objects, scope)) {  // steps 1 and C.1
    const Object& object = objects.at(id);
    const PanelCounts counts = panels.count(object.box, options.panel_tolerance_m);
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
