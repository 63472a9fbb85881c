// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An object's points as upright columns of the plan: where its surface begins and ends.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A square of the plan over which an object has points, the lowest and the highest. Unit: metre.
struct Column {
  std::int32_t x = 0;
  std::int32_t y = 0;
  double bottom_m = 0.0;
  double top_m = 0.0;
  friend bool operator==(const Column&, const Column&) = default;
};

/// Columns of a lattice through the origin of the map, ascending by x, then y.
class ColumnSurface {
 public:
  ColumnSurface() = default;
  /// Requires: points finite and within 1e6 m, edge_m >= 0.001. Cost: O(n log n).
  ColumnSurface(std::span<const Eigen::Vector3d> points_in_map, double edge_m);

  [[nodiscard]] std::span<const Column> columns() const noexcept { return columns_; }
  [[nodiscard]] bool empty() const noexcept { return columns_.empty(); }
  /// None when there are no points over that square. Cost: O(log n).
  [[nodiscard]] const Column* find(std::int32_t x, std::int32_t y) const;
  /// Columns whose middle is in the polygon or within `rim_m` of it, in order.
  /// Cost: the columns within the polygon's bounds in x.
  [[nodiscard]] std::vector<Column> within(const Polygon& polygon, double rim_m) const;
  /// The height that the highest `share` of the columns reach. Requires: not empty, share in
  /// (0, 1].
  [[nodiscard]] double height_reached_by(double share) const;

 private:
  double edge_m_ = 1.0;
  std::vector<Column> columns_;
};

/// The middle value, of an even number the lower of the two. Requires: not empty.
[[nodiscard]] double lower_median(std::vector<double> values);

}  // namespace hypermap
