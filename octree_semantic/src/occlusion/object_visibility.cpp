// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/occlusion/object_visibility.hpp"

#include "hypermap/core/objects/association.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// What a ray to one point of the object found.
enum class Sight : std::uint8_t { kOutside, kUntold, kOpen, kThrough, kHidden };

struct SightCounts {
  int total = 0;
  int in_view = 0;
  int open = 0;     // the object's surface is there
  int through = 0;  // what lies behind it is seen
  int hidden = 0;   // something stands in front

  [[nodiscard]] int told() const { return open + through + hidden; }
};

double share(int part, int whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Points of the object, at most `max_points`, spread evenly.
std::vector<Eigen::Vector3d> sample_points(const Object& object, int max_points) {
  std::vector<Eigen::Vector3d> points = object.points.agreed_points();
  if (points.empty()) {
    const auto corners = object.box.corners();
    points.assign(corners.begin(), corners.end());
    points.push_back(object.box.centre());
  }
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

/// Judges rays of one frame by what it measured; where it measured nothing, there is a line to ask
/// the map about.
class RayJudge {
 public:
  RayJudge(const RgbdFrame& frame, const VisibilityOptions& options)
      : frame_(&frame),
        options_(&options),
        max_range_m_(options.max_range_m.value_or(kDefaultMaxRangeM)),
        camera_from_map_(frame.map_from_camera.inverse()),
        camera_in_map_(frame.map_from_camera.origin()) {}

  /// kUntold: the last of `lines()` is about this point.
  [[nodiscard]] Sight judge(const Eigen::Vector3d& point_in_map, const Box& box) {
    const PointInCamera point = camera_from_map_ * PointInMap{point_in_map};
    const auto pixel = frame_->camera.project(point);
    if (!pixel || !(point.xyz.norm() <= max_range_m_)) return Sight::kOutside;
    if (!in_picture(*pixel)) return Sight::kOutside;
    const double depth_m = point.xyz.z();
    const double tolerance_m =
        options_->depth_tolerance_m + options_->depth_tolerance_per_m2 * depth_m * depth_m;
    const double entry_m = depth_m * entry_share(box, camera_in_map_.xyz, point_in_map);
    const auto measured = measured_around(*pixel, depth_m);
    if (!measured) {
      lines_.push_back({camera_in_map_, PointInMap{point_in_map}, 2.0 * tolerance_m});
      return Sight::kUntold;
    }
    if (*measured > depth_m + tolerance_m) return Sight::kThrough;
    // In front of the point but within the object's box: its own near side.
    return *measured < entry_m - tolerance_m ? Sight::kHidden : Sight::kOpen;
  }

  [[nodiscard]] const std::vector<SightLine>& lines() const { return lines_; }

 private:
  [[nodiscard]] bool in_picture(const PixelPoint& pixel) const {
    return pixel.u_px >= -0.5 && pixel.v_px >= -0.5 && pixel.u_px < frame_->camera.width_px - 0.5 &&
           pixel.v_px < frame_->camera.height_px - 0.5;
  }

  /// The measured depth of the pixel and its neighbours that is nearest to the expected one: at an
  /// outline a pixel more or less should not decide.
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
  std::vector<SightLine> lines_;
};

/// What the rays to each object found, one object after another.
struct Sights {
  std::vector<Sight> all;
  std::vector<std::size_t> ends;  ///< Behind the last one of each object.
};

/// What the frame left untold the map may tell: there is something that must hide the point.
Result<void> ask_the_map(std::vector<Sight>& sights,
                         std::span<const SightLine> lines,
                         const AnswerLines& answer) {
  if (lines.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::uint8_t> hidden, answer(lines));
  std::size_t next = 0;
  for (Sight& sight : sights) {
    if (sight == Sight::kUntold && hidden[next++] != 0) sight = Sight::kHidden;
  }
  return {};
}

Result<Sights> look_at(const ObjectMap& objects,
                       std::span<const ObjectId> ids,
                       const RgbdFrame& frame,
                       const AnswerLines& answer,
                       const VisibilityOptions& options) {
  RayJudge judge(frame, options);
  Sights sights;
  for (const ObjectId id : ids) {
    const Object& object = objects.at(id);
    for (const Eigen::Vector3d& point : sample_points(object, options.max_rays)) {
      sights.all.push_back(judge.judge(point, object.box));
    }
    sights.ends.push_back(sights.all.size());
  }
  HYPERMAP_TRY(ask_the_map(sights.all, judge.lines(), answer));
  return sights;
}

SightCounts count(std::span<const Sight> sights) {
  SightCounts counts;
  for (const Sight sight : sights) {
    ++counts.total;
    counts.in_view += sight != Sight::kOutside ? 1 : 0;
    counts.open += sight == Sight::kOpen ? 1 : 0;
    counts.through += sight == Sight::kThrough ? 1 : 0;
    counts.hidden += sight == Sight::kHidden ? 1 : 0;
  }
  return counts;
}

Visibility state_of(const SightCounts& counts, const VisibilityOptions& options) {
  if (share(counts.in_view, counts.total) < options.min_in_view_share || counts.told() == 0) {
    return Visibility::kOutOfView;
  }
  const int seen = counts.open + counts.through;
  if (seen == 0 || share(seen, counts.told()) < options.min_open_share) {
    return Visibility::kOccluded;
  }
  if (share(counts.through, seen) >= options.absent_share) return Visibility::kAbsent;
  const bool partly = share(counts.hidden, counts.told()) >= options.partly_occluded_share;
  return partly ? Visibility::kPartlyOccluded : Visibility::kVisible;
}

/// Detected in this very frame, so it is there and not wholly hidden, whatever the rays say.
Visibility state_of_detected(Visibility by_rays) {
  return by_rays == Visibility::kPartlyOccluded ? by_rays : Visibility::kVisible;
}

/// Box around all that the camera overlooks up to the range.
Box overlooked(const RgbdFrame& frame, double max_range_m) {
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

Result<std::vector<VisibilityVerdict>> judge_visibility(const ObjectMap& objects,
                                                        const RgbdFrame& frame,
                                                        const AnswerLines& answer,
                                                        const VisibilityOptions& options,
                                                        std::span<const ObjectId> seen_now) {
  const std::vector<ObjectId> ids =
      objects.query(overlooked(frame, options.max_range_m.value_or(kDefaultMaxRangeM)));
  HYPERMAP_ASSIGN_OR_RETURN(const Sights sights, look_at(objects, ids, frame, answer, options));
  const Eigen::Vector3d camera = frame.map_from_camera.origin().xyz;
  std::vector<VisibilityVerdict> verdicts;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Object& object = objects.at(ids[i]);
    const std::size_t end = sights.ends[i];
    const SightCounts counts = count(std::span(sights.all).subspan(begin, end - begin));
    begin = end;
    const bool is_seen = std::binary_search(seen_now.begin(), seen_now.end(), ids[i]);
    const Visibility by_rays = state_of(counts, options);
    verdicts.push_back({.object = ids[i],
                        .state = is_seen ? state_of_detected(by_rays) : by_rays,
                        .visible_fraction = share(counts.open, counts.total),
                        .absent_fraction = share(counts.through, counts.total),
                        .bearing_rad = bearing_from_object_rad(object.centroid_in_map, camera),
                        .distance_m = (camera - object.centroid_in_map).norm()});
  }
  return verdicts;
}

}  // namespace hypermap
