// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/box.hpp"

#include <cassert>
#include <cstddef>

namespace hypermap {

std::array<Eigen::Vector3d, 8> Box::corners() const {
  std::array<Eigen::Vector3d, 8> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = {(i & 1U) != 0 ? max_in_map.x() : min_in_map.x(),
              (i & 2U) != 0 ? max_in_map.y() : min_in_map.y(),
              (i & 4U) != 0 ? max_in_map.z() : min_in_map.z()};
  }
  return out;
}

Box bounding_box(std::span<const Eigen::Vector3f> points_in_map) {
  assert(!points_in_map.empty());
  Eigen::Vector3f low = points_in_map.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& point : points_in_map) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return {low.cast<double>(), high.cast<double>()};
}

double intersection_over_union(const Box& a, const Box& b) {
  const Eigen::Vector3d low = a.min_in_map.cwiseMax(b.min_in_map);
  const Eigen::Vector3d high = a.max_in_map.cwiseMin(b.max_in_map);
  const double common = (high - low).cwiseMax(0.0).prod();
  const double united = a.volume_m3() + b.volume_m3() - common;
  return united > 0.0 ? common / united : 0.0;
}

}  // namespace hypermap
