// SPDX-License-Identifier: BSD-3-Clause
#include "point_tree.hpp"

#include <algorithm>
#include <numeric>

namespace hypermap {
namespace {

constexpr std::uint32_t kPointsPerLeaf = 8;
/// Rounding must not lose a point at the rim of its ball.
constexpr double kRimM = 1e-9;

}  // namespace

PointTree::PointTree(std::span<const Eigen::Vector3d> points)
    : points_(points), order_(points.size()) {
  if (points.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.push_back(node_of(0, static_cast<std::uint32_t>(points.size())));
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

PointTree::Node PointTree::node_of(std::uint32_t first, std::uint32_t last) const {
  Eigen::Vector3d low = points_[order_[first]];
  Eigen::Vector3d high = low;
  for (std::uint32_t i = first; i < last; ++i) {
    low = low.cwiseMin(points_[order_[i]]);
    high = high.cwiseMax(points_[order_[i]]);
  }
  return {.centre = 0.5 * (low + high),
          .radius_m = 0.5 * (high - low).norm() + kRimM,
          .first = first,
          .last = last};
}

void PointTree::split(std::uint32_t at) {
  const Node node = nodes_[at];
  if (node.last - node.first <= kPointsPerLeaf) return;
  Eigen::Vector3d low = points_[order_[node.first]];
  Eigen::Vector3d high = low;
  for (std::uint32_t i = node.first; i < node.last; ++i) {
    low = low.cwiseMin(points_[order_[i]]);
    high = high.cwiseMax(points_[order_[i]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = node.first + (node.last - node.first) / 2;
  const auto is_before = [this, axis](std::uint32_t a, std::uint32_t b) {
    const double x = points_[a][axis];
    const double y = points_[b][axis];
    return x < y || (x == y && a < b);
  };
  std::nth_element(
      order_.begin() + node.first, order_.begin() + middle, order_.begin() + node.last, is_before);
  nodes_[at].left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node_of(node.first, middle));
  nodes_.push_back(node_of(middle, node.last));
}

}  // namespace hypermap
