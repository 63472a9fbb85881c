// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where an object's own points are, coarsely: whether a surface inside its box is its own.
#pragma once

#include "hypermap/core/geometry/box.hpp"

#include <Eigen/Core>

#include <bitset>
#include <cstddef>
#include <optional>
#include <span>

namespace hypermap {

/// Cells of a box, 16 along its longest side, that a point of the object lies in; points beside the
/// box are left out. Frame: Map.
class KnownSurface {
 public:
  /// Cells are `min_edge_m` wide at least. Requires: min_edge_m > 0. Cost: O(points).
  KnownSurface(std::span<const Eigen::Vector3d> points_in_map, const Box& box, double min_edge_m);

  /// Whether the cell of the point or one beside it has a point of the object.
  [[nodiscard]] bool is_near(const Eigen::Vector3d& point_in_map) const;

 private:
  static constexpr int kCellsPerSide = 16;

  [[nodiscard]] Eigen::Array3i cell_of(const Eigen::Vector3d& point_in_map) const;
  [[nodiscard]] static std::optional<std::size_t> index_of(const Eigen::Array3i& cell);

  Eigen::Vector3d origin_in_map_;
  double edge_m_;
  std::bitset<std::size_t{kCellsPerSide} * kCellsPerSide * kCellsPerSide> cells_;
};

}  // namespace hypermap
