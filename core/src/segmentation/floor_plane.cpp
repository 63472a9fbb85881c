// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plane.hpp"

#include "plane_test.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

/// Of the tolerance of a plane, how far below it points are no noise of it.
constexpr float kBelowScale = 2.0F;
/// Of the least that makes a floor, so many points may be below it by errors of the sensor.
constexpr double kMaxBelowShare = 0.25;

/// The heights of the lowest `count` points, ascending.
std::vector<float> lowest_heights_m(const PlanePoints& points,
                                    const Eigen::Vector3f& up_in_camera,
                                    std::size_t count) {
  std::vector<float> heights_m;
  heights_m.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    heights_m.push_back(up_in_camera.dot(points[i]));
  }
  const auto end = heights_m.begin() + static_cast<std::ptrdiff_t>(std::min(count, points.size()));
  std::partial_sort(heights_m.begin(), end, heights_m.end());
  heights_m.erase(end, heights_m.end());
  return heights_m;
}

std::size_t num_below(const Plane& plane,
                      const PlanePoints& points,
                      const ForegroundOptions& options) {
  PlaneTest test = test_of(plane, options);
  test.scale = kBelowScale;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_lower = plane.distance_m(points[i]) < 0.0F;
    count += is_lower && !points.lies_on(test, i) ? 1U : 0U;
  }
  return count;
}

}  // namespace

std::optional<Plane> floor_around(const PlanePoints& all,
                                  const PlanePoints& left,
                                  const Eigen::Vector3f& up_in_camera,
                                  std::size_t least,
                                  const ForegroundOptions& options) {
  std::optional<Plane> floor;
  std::size_t most = least - 1;
  for (const float height_m : lowest_heights_m(left, up_in_camera, 2 * least)) {
    const Plane plane{up_in_camera, -height_m};
    const std::size_t support = left.count(test_of(plane, options), 0, left.size());
    if (support <= most) continue;
    const auto below = static_cast<double>(num_below(plane, all, options));
    if (below > kMaxBelowShare * static_cast<double>(least)) continue;
    floor = plane;
    most = support;
  }
  return floor;
}

}  // namespace hypermap
