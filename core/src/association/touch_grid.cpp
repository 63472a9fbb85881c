// SPDX-License-Identifier: BSD-3-Clause
#include "touch_grid.hpp"

#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

struct Cell {
  std::int64_t x;
  std::int64_t y;
  std::int64_t z;
};

Cell cell_of(const Eigen::Vector3d& p, double edge_m) {
  return {static_cast<std::int64_t>(std::floor(p.x() / edge_m)),
          static_cast<std::int64_t>(std::floor(p.y() / edge_m)),
          static_cast<std::int64_t>(std::floor(p.z() / edge_m))};
}

/// 21 bits an axis. Cells two million cells apart share a key, which no two objects are.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  return (static_cast<std::uint64_t>(x) & kMask) << 42U |
         (static_cast<std::uint64_t>(y) & kMask) << 21U | (static_cast<std::uint64_t>(z) & kMask);
}

}  // namespace

TouchGrid::TouchGrid(std::span<const Eigen::Vector3d> points, double near_m) : near_m_(near_m) {
  cells_.reserve(2 * points.size());
  for (const Eigen::Vector3d& p : points) {
    const Cell c = cell_of(p, near_m_);
    cells_.insert(key_of(c.x, c.y, c.z));
  }
}

bool TouchGrid::is_near(const Eigen::Vector3d& point) const {
  const Cell c = cell_of(point, near_m_);
  for (std::int64_t dx = -1; dx <= 1; ++dx) {
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dz = -1; dz <= 1; ++dz) {
        if (cells_.contains(key_of(c.x + dx, c.y + dy, c.z + dz))) return true;
      }
    }
  }
  return false;
}

double TouchGrid::share_near(std::span<const Eigen::Vector3d> points) const {
  if (points.empty()) return 0.0;
  std::size_t num_near = 0;
  for (const Eigen::Vector3d& p : points) num_near += is_near(p) ? 1U : 0U;
  return static_cast<double>(num_near) / static_cast<double>(points.size());
}

}  // namespace hypermap
