// SPDX-License-Identifier: BSD-3-Clause
#include "octree/point_mask.hpp"

#include <algorithm>

namespace hypermap {
namespace {

constexpr double kMaxCells = 1'048'576.0;

Box bounds_of(std::span<const Eigen::Vector3d> points) {
  Box bounds{points.front(), points.front()};
  for (const Eigen::Vector3d& p : points) {
    bounds.min_in_map = bounds.min_in_map.cwiseMin(p);
    bounds.max_in_map = bounds.max_in_map.cwiseMax(p);
  }
  return bounds;
}

}  // namespace

PointMask::PointMask(std::span<const Eigen::Vector3d> points, double edge_m) : edge_m_(edge_m) {
  if (points.empty()) return;
  const Box bounds = bounds_of(points);
  const auto cells_at = [&bounds](double edge) {
    return Eigen::Array3d((bounds.extent().array() / edge).floor() + 1.0);
  };
  while (cells_at(edge_m_).prod() > kMaxCells) edge_m_ *= 2.0;
  low_ = bounds.min_in_map;
  size_ = cells_at(edge_m_).cast<std::int64_t>();
  cells_.resize(static_cast<std::size_t>(size_.prod()));
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Array3<std::int64_t> cell =
        ((p - low_).array() / edge_m_).floor().cast<std::int64_t>().min(size_ - 1);
    cells_[index_of(cell.x(), cell.y(), cell.z())] = true;
  }
}

std::size_t PointMask::index_of(std::int64_t x, std::int64_t y, std::int64_t z) const noexcept {
  return static_cast<std::size_t>((x * size_.y() + y) * size_.z() + z);
}

PointMask::CellRange PointMask::cells_in(const Box& box) const noexcept {
  // Held within the mask before they become integers.
  const Eigen::Array3d most = size_.cast<double>();
  const auto cell_of = [&](const Eigen::Vector3d& p, double beyond) {
    const Eigen::Array3d cell = ((p - low_).array() / edge_m_).floor() + beyond;
    return Eigen::Array3<std::int64_t>(cell.max(0.0).min(most).cast<std::int64_t>());
  };
  return {cell_of(box.min_in_map, 0.0), cell_of(box.max_in_map, 1.0)};
}

std::size_t PointMask::count(const Box& box) const noexcept {
  const CellRange range = cells_in(box);
  std::size_t taken = 0;
  for (std::int64_t x = range.low.x(); x < range.high.x(); ++x) {
    for (std::int64_t y = range.low.y(); y < range.high.y(); ++y) {
      for (std::int64_t z = range.low.z(); z < range.high.z(); ++z) {
        taken += cells_[index_of(x, y, z)] ? 1U : 0U;
      }
    }
  }
  return taken;
}

}  // namespace hypermap
