// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Nearest neighbours of points that lie anywhere.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hypermap {

/// Which points are nearest to one of them, by PCL's kd tree.
class TreeNeighbours {
 public:
  explicit TreeNeighbours(const std::vector<Eigen::Vector3f>& points);
  ~TreeNeighbours();
  TreeNeighbours(const TreeNeighbours&) = delete;
  TreeNeighbours& operator=(const TreeNeighbours&) = delete;

  /// The `count` points nearest to `point`, itself among them, the nearest first. Requires: no more
  /// than there are. Valid until the next call.
  [[nodiscard]] std::span<const std::uint32_t> nearest(std::uint32_t point, std::size_t count);

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace hypermap
