// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points in space, found by their distance from a triangle.
#pragma once

#include "hypermap/core/geometry/triangle.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A tree over points; each node splits its box's longest side at the median.
class PointTree {
 public:
  /// `points` must outlive the tree. Cost: O(n log^2 n).
  explicit PointTree(std::span<const Eigen::Vector3d> points);

  /// Calls `visit(index, squared_distance)` for each point no farther than `reach_m` from the
  /// triangle. Cost: the nodes near the triangle.
  template <class Visit>
  void for_each_near(const Triangle& triangle, double reach_m, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, triangle, reach_m, visit);
  }

 private:
  /// A range of `order_`; children lie at `left` and `left + 1`, a leaf has none (0).
  struct Node {
    Eigen::Vector3d centre;
    double radius_m = 0.0;  ///< Of a ball about the centre that holds all of its points.
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::uint32_t left = 0;
  };

  void split(std::uint32_t node);
  [[nodiscard]] Node node_of(std::uint32_t first, std::uint32_t last) const;

  template <class Visit>
  void descend(std::uint32_t at,
               const Triangle& triangle,
               double reach_m,
               const Visit& visit) const {
    const Node& node = nodes_[at];
    const double reach_of_node_m = reach_m + node.radius_m;
    if (squared_distance(node.centre, triangle) > reach_of_node_m * reach_of_node_m) return;
    if (node.left != 0) {
      descend(node.left, triangle, reach_m, visit);
      descend(node.left + 1, triangle, reach_m, visit);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const double distance2 = squared_distance(points_[order_[i]], triangle);
      if (distance2 <= reach_m * reach_m) visit(std::size_t{order_[i]}, distance2);
    }
  }

  std::span<const Eigen::Vector3d> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace hypermap
