// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points in space, found by their distance from a triangle or from each other.
#pragma once

#include "hypermap/core/geometry/triangle.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
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

  /// The least `distance(index)` over the points; infinity without points.
  /// Requires: distance(index) is no less than the point's distance from `place` minus `slack_m`.
  /// Cost: the nodes about as near as the nearest point.
  template <class Distance>
  [[nodiscard]] double least_distance(const Eigen::Vector3d& place,
                                      double slack_m,
                                      const Distance& distance) const {
    double least = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) approach(0, place, slack_m, distance, least);
    return least;
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

  [[nodiscard]] double least_possible(std::uint32_t at,
                                      const Eigen::Vector3d& place,
                                      double slack_m) const {
    return (nodes_[at].centre - place).norm() - nodes_[at].radius_m - slack_m;
  }

  /// Lowers `least` by what lies below the node.
  template <class Distance>
  void approach(std::uint32_t at,
                const Eigen::Vector3d& place,
                double slack_m,
                const Distance& distance,
                double& least) const {
    const Node& node = nodes_[at];
    if (node.left == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i)
        least = std::min(least, distance(std::size_t{order_[i]}));
      return;
    }
    std::array<std::pair<double, std::uint32_t>, 2> children;
    for (std::uint32_t i = 0; i < 2; ++i)
      children[i] = {least_possible(node.left + i, place, slack_m), node.left + i};
    if (children[1].first < children[0].first) std::swap(children[0], children[1]);
    for (const auto& [possible, child] : children)
      if (possible < least) approach(child, place, slack_m, distance, least);
  }

  std::span<const Eigen::Vector3d> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace hypermap
