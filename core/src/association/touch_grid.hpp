// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which points lie near a set of points.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <unordered_set>

namespace hypermap {

/// The cells that points fall into; what lies in one of them or next to one is near.
class TouchGrid {
 public:
  /// Points up to `near_m` away are near, those beyond twice that never. Requires: near_m > 0.
  TouchGrid(std::span<const Eigen::Vector3d> points, double near_m);

  [[nodiscard]] bool is_near(const Eigen::Vector3d& point) const;
  /// Of `points`, those that are near; 0 when there are none.
  [[nodiscard]] double share_near(std::span<const Eigen::Vector3d> points) const;

 private:
  double near_m_;
  std::unordered_set<std::uint64_t> cells_;  ///< Only asked, never iterated.
};

}  // namespace hypermap
