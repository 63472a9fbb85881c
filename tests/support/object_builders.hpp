// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Objects in words: boxes of points, observations of them, class vectors.
#pragma once

#include "hypermap/core/objects/association.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hypermap::testing_support {

inline constexpr std::uint32_t kNumClasses = 10;

/// `p` on one class, the rest spread over the other nine.
inline std::vector<ClassEvidence> scores(ClassId id, double p) {
  std::vector<ClassEvidence> out;
  for (std::uint32_t c = 0; c < kNumClasses; ++c) {
    out.push_back({ClassId{c}, Probability(c == id.value ? p : (1.0 - p) / (kNumClasses - 1))});
  }
  return out;
}

inline Box box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  return {centre - 0.5 * size, centre + 0.5 * size};
}

/// Points of all six faces, `spacing_m` apart.
inline std::vector<Eigen::Vector3f> surface_of(const Box& box, double spacing_m = 0.02) {
  std::vector<Eigen::Vector3f> points;
  const Eigen::Vector3d size = box.extent();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const int nu = std::max(1, static_cast<int>(std::lround(size[u] / spacing_m)));
    const int nv = std::max(1, static_cast<int>(std::lround(size[v] / spacing_m)));
    for (int i = 0; i <= nu; ++i) {
      for (int k = 0; k <= nv; ++k) {
        for (const double side : {0.0, 1.0}) {
          Eigen::Vector3d p = box.min_in_map;
          p[axis] += side * size[axis];
          p[u] += size[u] * i / nu;
          p[v] += size[v] * k / nv;
          points.emplace_back(p.cast<float>());
        }
      }
    }
  }
  return points;
}

/// Those points that `keep` accepts.
template <class Keep>
std::vector<Eigen::Vector3f> only(std::vector<Eigen::Vector3f> points, const Keep& keep) {
  std::erase_if(points, [&](const Eigen::Vector3f& p) { return !keep(p); });
  return points;
}

/// Seen by a camera at `camera`.
inline Observation observed(std::vector<Eigen::Vector3f> points,
                            std::vector<ClassEvidence> class_scores,
                            std::uint64_t frame_index = 0,
                            const Eigen::Vector3d& camera = {0.0, -2.0, 1.2}) {
  Observation out;
  out.segment.box = bounding_box(points);
  out.segment.points_in_map = std::move(points);
  out.segment.centroid_in_map = out.segment.box.centre();
  out.segment.box_confidence = Probability(0.8);
  out.segment.distance_m = (camera - out.segment.centroid_in_map).norm();
  out.class_scores = std::move(class_scores);
  out.score = Probability(0.7);
  out.bearing_rad = bearing_from_object_rad(out.segment.centroid_in_map, camera);
  out.distance_m = out.segment.distance_m;
  out.stamp = Stamp{static_cast<std::int64_t>(frame_index) * 100'000'000};
  out.frame_index = frame_index;
  return out;
}

}  // namespace hypermap::testing_support
