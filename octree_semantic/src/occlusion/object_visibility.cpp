// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/occlusion/object_visibility.hpp"

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/observation_log.hpp"
#include "occlusion/known_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

/// Cells of an object's own surface are no finer, whatever the tolerance.
constexpr double kLeastSurfaceEdgeM = 0.01;

/// Result of a ray to one point of the object.
enum class RayOutcome : std::uint8_t { kOutside, kNoDepth, kOpen, kThrough, kHidden };

struct RayCounts {
  int total = 0;
  int in_view = 0;
  int open = 0;     // the measured depth is that of the object
  int through = 0;  // the measured depth is behind the object
  int hidden = 0;   // the measured depth, or the map, is in front of the object

  [[nodiscard]] int num_decided() const { return open + through + hidden; }
  [[nodiscard]] int outside() const { return total - in_view; }
};

double share(int part, int whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Points that stand for an object without points of its own.
std::vector<Eigen::Vector3d> box_points(const Box& box) {
  const auto corners = box.corners();
  std::vector<Eigen::Vector3d> points(corners.begin(), corners.end());
  points.push_back(box.centre());
  return points;
}

/// At most `max_points` of them, spread evenly.
std::vector<Eigen::Vector3d> sample_of(std::vector<Eigen::Vector3d> points, int max_points) {
  const auto limit = static_cast<std::size_t>(max_points);
  if (points.size() <= limit) return points;
  for (std::size_t i = 0; i < limit; ++i) points[i] = points[i * points.size() / limit];
  points.resize(limit);
  return points;
}

/// Share of the way from `from` to `to` at which the line enters the box; 0 when it starts inside.
double entry_share(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double entry = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double way = to[i] - from[i];
    if (way == 0.0) continue;
    const double a = (box.min_in_map[i] - from[i]) / way;
    const double b = (box.max_in_map[i] - from[i]) / way;
    entry = std::max(entry, std::min(a, b));
  }
  return std::min(entry, 1.0);
}

double depth_tolerance_m(const VisibilityOptions& options, double depth_m) {
  return options.depth_tolerance_m + options.depth_tolerance_per_m2 * depth_m * depth_m;
}

/// Evaluates rays of one frame by its depth; those without depth become occlusion rays in the map.
class RayEvaluator {
 public:
  RayEvaluator(const RgbdFrame& frame, const VisibilityOptions& options)
      : frame_(&frame),
        options_(&options),
        max_range_m_(options.max_range_m.value_or(kDefaultMaxRangeM)),
        camera_from_map_(frame.map_from_camera.inverse()),
        camera_in_map_(frame.map_from_camera.origin()) {}

  /// kNoDepth: the last of `rays()` ends at this point. `near_side`: where what is measured in
  /// front of the point, within the box, is the object's own; everywhere when null.
  [[nodiscard]] RayOutcome evaluate(const Eigen::Vector3d& point_in_map,
                                    const Box& box,
                                    const KnownSurface* near_side) {
    const PointInCamera point = camera_from_map_ * PointInMap{point_in_map};
    const auto pixel = frame_->camera.project(point);
    if (!pixel || !(point.xyz.norm() <= max_range_m_)) return RayOutcome::kOutside;
    if (!in_image(*pixel)) return RayOutcome::kOutside;
    const double depth_m = point.xyz.z();
    const double tolerance_m = depth_tolerance_m(*options_, depth_m);
    const double entry_m = depth_m * entry_share(box, camera_in_map_.xyz, point_in_map);
    const auto measured = measured_around(*pixel, depth_m);
    if (!measured) {
      rays_.push_back({camera_in_map_, PointInMap{point_in_map}, 2.0 * tolerance_m});
      return RayOutcome::kNoDepth;
    }
    if (*measured > depth_m + tolerance_m) return RayOutcome::kThrough;
    if (*measured < entry_m - tolerance_m) return RayOutcome::kHidden;
    if (near_side == nullptr || *measured >= depth_m - tolerance_m) return RayOutcome::kOpen;
    const Eigen::Vector3d& camera = camera_in_map_.xyz;
    const Eigen::Vector3d surface = camera + *measured / depth_m * (point_in_map - camera);
    return near_side->is_near(surface) ? RayOutcome::kOpen : RayOutcome::kHidden;
  }

  [[nodiscard]] const std::vector<OcclusionRay>& rays() const { return rays_; }

 private:
  [[nodiscard]] bool in_image(const PixelPoint& pixel) const {
    return pixel.u_px >= -0.5 && pixel.v_px >= -0.5 && pixel.u_px < frame_->camera.width_px - 0.5 &&
           pixel.v_px < frame_->camera.height_px - 0.5;
  }

  /// The measured depth of the pixel and its neighbours that is nearest to the expected one: robust
  /// against one pixel at outlines.
  [[nodiscard]] std::optional<double> measured_around(const PixelPoint& pixel,
                                                      double expected_m) const {
    const int u = static_cast<int>(std::lround(pixel.u_px));
    const int v = static_cast<int>(std::lround(pixel.v_px));
    std::optional<double> best;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        if (!frame_->depth_m.contains(u + du, v + dv)) continue;
        const auto depth_m = static_cast<double>(frame_->depth_m.at(u + du, v + dv));
        if (!(depth_m > 0.0) || !std::isfinite(depth_m)) continue;
        if (!best || std::abs(depth_m - expected_m) < std::abs(*best - expected_m)) best = depth_m;
      }
    }
    return best;
  }

  const RgbdFrame* frame_;
  const VisibilityOptions* options_;
  double max_range_m_;
  Transform<frame::Camera, frame::Map> camera_from_map_;
  PointInMap camera_in_map_;
  std::vector<OcclusionRay> rays_;
};

/// Results of the rays to each object, one object after another.
struct RayOutcomes {
  std::vector<RayOutcome> all;
  std::vector<std::size_t> ends;  ///< Behind the last one of each object.
};

/// Rays without depth are occluded when the map's own geometry occludes them.
Result<void> query_occlusion(std::vector<RayOutcome>& outcomes,
                             std::span<const OcclusionRay> rays,
                             const OcclusionQuery& query) {
  if (rays.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::uint8_t> hidden, query(rays));
  std::size_t next = 0;
  for (RayOutcome& outcome : outcomes) {
    if (outcome == RayOutcome::kNoDepth && hidden[next++] != 0) outcome = RayOutcome::kHidden;
  }
  return {};
}

/// Whether it was detected from within 40 to 60 degrees of that direction, by where in its bin each
/// lies: from there mostly the same sides are seen.
bool was_detected_from_about(const ObservationLog& log, double bearing_rad) {
  constexpr double kBinRad = 2.0 * std::numbers::pi / ObservationLog::kNumBearingBins;
  // Each count is of a bin and those beside it.
  return num_detections_from(log, bearing_rad - kBinRad) > 0 ||
         num_detections_from(log, bearing_rad + kBinRad) > 0;
}

/// Where the object's surface is that turns to the camera; none where that may never have been
/// seen.
std::optional<KnownSurface> known_near_side(const Object& object,
                                            std::span<const Eigen::Vector3d> points_in_map,
                                            const Eigen::Vector3d& camera_in_map,
                                            const VisibilityOptions& options) {
  const double bearing_rad = bearing_from_object_rad(object.centroid_in_map, camera_in_map);
  if (points_in_map.empty() || !was_detected_from_about(object.observation_log, bearing_rad))
    return std::nullopt;
  const double tolerance_m =
      depth_tolerance_m(options, (object.centroid_in_map - camera_in_map).norm());
  return KnownSurface(points_in_map,
                      object.box,
                      std::max({tolerance_m, object.points.state().edge_m, kLeastSurfaceEdgeM}));
}

Result<RayOutcomes> cast_rays(const ObjectMap& objects,
                              std::span<const ObjectId> ids,
                              const RgbdFrame& frame,
                              const OcclusionQuery& query,
                              const VisibilityOptions& options) {
  RayEvaluator evaluator(frame, options);
  const Eigen::Vector3d camera_in_map = frame.map_from_camera.origin().xyz;
  RayOutcomes outcomes;
  for (const ObjectId id : ids) {
    const Object& object = objects.at(id);
    std::vector<Eigen::Vector3d> points = object.points.agreed_points();
    const auto near_side = known_near_side(object, points, camera_in_map, options);
    if (points.empty()) points = box_points(object.box);
    for (const Eigen::Vector3d& point : sample_of(std::move(points), options.max_rays)) {
      outcomes.all.push_back(
          evaluator.evaluate(point, object.box, near_side ? &*near_side : nullptr));
    }
    outcomes.ends.push_back(outcomes.all.size());
  }
  HYPERMAP_TRY(query_occlusion(outcomes.all, evaluator.rays(), query));
  return outcomes;
}

RayCounts count(std::span<const RayOutcome> outcomes) {
  RayCounts counts;
  for (const RayOutcome outcome : outcomes) {
    ++counts.total;
    counts.in_view += outcome != RayOutcome::kOutside ? 1 : 0;
    counts.open += outcome == RayOutcome::kOpen ? 1 : 0;
    counts.through += outcome == RayOutcome::kThrough ? 1 : 0;
    counts.hidden += outcome == RayOutcome::kHidden ? 1 : 0;
  }
  return counts;
}

Visibility state_of(const RayCounts& counts, const VisibilityOptions& options) {
  if (share(counts.in_view, counts.total) < options.min_in_view_share ||
      counts.num_decided() == 0) {
    return Visibility::kOutOfView;
  }
  const int seen = counts.open + counts.through;
  if (seen == 0 || share(seen, counts.num_decided()) < options.min_open_share) {
    return Visibility::kOccluded;
  }
  if (share(counts.through, seen) >= options.absent_share) {
    // A rim of it is seen through, what is beside the image may be where it was: no verdict.
    const bool is_gone = share(counts.through, seen + counts.outside()) >= options.absent_share;
    return is_gone ? Visibility::kAbsent : Visibility::kOutOfView;
  }
  const bool partly = share(counts.hidden, counts.num_decided()) >= options.partly_occluded_share;
  return partly ? Visibility::kPartlyOccluded : Visibility::kVisible;
}

/// A detected object is neither absent nor fully occluded, whatever the rays found.
Visibility state_of_detected(Visibility by_rays) {
  return by_rays == Visibility::kPartlyOccluded ? by_rays : Visibility::kVisible;
}

/// Bounds of the view frustum up to the range.
Box frustum_bounds(const RgbdFrame& frame, double max_range_m) {
  const Eigen::Vector3d origin = frame.map_from_camera.origin().xyz;
  Box box{origin, origin};
  for (const double u : {-0.5, frame.camera.width_px - 0.5}) {
    for (const double v : {-0.5, frame.camera.height_px - 0.5}) {
      const auto corner = frame.camera.unproject(u, v, max_range_m);
      const Eigen::Vector3d in_map = (frame.map_from_camera * corner).xyz;
      box.min_in_map = box.min_in_map.cwiseMin(in_map);
      box.max_in_map = box.max_in_map.cwiseMax(in_map);
    }
  }
  return box;
}

}  // namespace

Result<std::vector<VisibilityResult>> evaluate_visibility(const ObjectMap& objects,
                                                          const RgbdFrame& frame,
                                                          const OcclusionQuery& query,
                                                          const VisibilityOptions& options,
                                                          std::span<const ObjectId> detected) {
  const std::vector<ObjectId> ids =
      objects.query(frustum_bounds(frame, options.max_range_m.value_or(kDefaultMaxRangeM)));
  HYPERMAP_ASSIGN_OR_RETURN(const RayOutcomes outcomes,
                            cast_rays(objects, ids, frame, query, options));
  const Eigen::Vector3d camera = frame.map_from_camera.origin().xyz;
  std::vector<VisibilityResult> results;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Object& object = objects.at(ids[i]);
    const std::size_t end = outcomes.ends[i];
    const RayCounts counts = count(std::span(outcomes.all).subspan(begin, end - begin));
    begin = end;
    const bool is_detected = std::binary_search(detected.begin(), detected.end(), ids[i]);
    const Visibility by_rays = state_of(counts, options);
    results.push_back({.object = ids[i],
                       .state = is_detected ? state_of_detected(by_rays) : by_rays,
                       .visible_fraction = share(counts.open, counts.total),
                       .absent_fraction = share(counts.through, counts.total),
                       .bearing_rad = bearing_from_object_rad(object.centroid_in_map, camera),
                       .distance_m = (camera - object.centroid_in_map).norm()});
  }
  return results;
}

}  // namespace hypermap
