// SPDX-License-Identifier: BSD-3-Clause
#include "occlusion/known_surface.hpp"

#include <algorithm>

namespace hypermap {

KnownSurface::KnownSurface(std::span<const Eigen::Vector3d> points_in_map,
                           const Box& box,
                           double min_edge_m)
    : origin_in_map_(box.min_in_map),
      edge_m_(std::max(min_edge_m, (box.max_in_map - box.min_in_map).maxCoeff() / kCellsPerSide)) {
  for (const Eigen::Vector3d& point : points_in_map) {
    if (const auto index = index_of(cell_of(point))) cells_.set(*index);
  }
}

bool KnownSurface::is_near(const Eigen::Vector3d& point_in_map) const {
  const Eigen::Array3i centre = cell_of(point_in_map);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const auto index = index_of(centre + Eigen::Array3i(x, y, z));
        if (index && cells_.test(*index)) return true;
      }
    }
  }
  return false;
}

Eigen::Array3i KnownSurface::cell_of(const Eigen::Vector3d& point_in_map) const {
  // Bounded before the cast: points of a file may lie anywhere.
  const Eigen::Array3d cells = ((point_in_map - origin_in_map_) / edge_m_).array().floor();
  return cells.cwiseMax(-2.0).cwiseMin(kCellsPerSide + 1.0).cast<int>();
}

std::optional<std::size_t> KnownSurface::index_of(const Eigen::Array3i& cell) {
  if ((cell < 0).any() || (cell >= kCellsPerSide).any()) return std::nullopt;
  return static_cast<std::size_t>((cell.x() * kCellsPerSide + cell.y()) * kCellsPerSide + cell.z());
}

}  // namespace hypermap
