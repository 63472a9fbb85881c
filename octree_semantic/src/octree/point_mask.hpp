// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which small cells have a point, in a box around all of them.
#pragma once

#include "hypermap/core/geometry/box.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A bit for each cell. Frame: that of the points.
class PointMask {
 public:
  /// Cells of `edge_m`, doubled until at most 2^20 of them hold all points. Requires: finite
  /// points.
  PointMask(std::span<const Eigen::Vector3d> points, double edge_m);

  /// How many of the cells that the box touches have a point.
  [[nodiscard]] std::size_t count(const Box& box) const noexcept;
  [[nodiscard]] bool empty() const noexcept { return cells_.empty(); }

 private:
  /// From `low` up to, not including, `high`, on each axis.
  struct CellRange {
    Eigen::Array3<std::int64_t> low;
    Eigen::Array3<std::int64_t> high;
  };
  [[nodiscard]] CellRange cells_in(const Box& box) const noexcept;
  [[nodiscard]] std::size_t index_of(std::int64_t x, std::int64_t y, std::int64_t z) const noexcept;

  double edge_m_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();  ///< Lowest corner of cell 0, 0, 0.
  Eigen::Array3<std::int64_t> size_ = Eigen::Array3<std::int64_t>::Zero();
  std::vector<bool> cells_;
};

}  // namespace hypermap
