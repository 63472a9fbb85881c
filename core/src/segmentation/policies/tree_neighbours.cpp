// SPDX-License-Identifier: BSD-3-Clause
#include "tree_neighbours.hpp"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

namespace hypermap {

struct TreeNeighbours::Tree {
  pcl::search::KdTree<pcl::PointXYZ> tree;
  pcl::Indices indices;
  std::vector<float> squares_m2;
  std::vector<std::uint32_t> nearest;
};

TreeNeighbours::TreeNeighbours(const std::vector<Eigen::Vector3f>& points)
    : tree_(std::make_unique<Tree>()) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& at : points) cloud->push_back({at.x(), at.y(), at.z()});
  tree_->tree.setInputCloud(cloud);
}

TreeNeighbours::~TreeNeighbours() = default;

std::span<const std::uint32_t> TreeNeighbours::nearest(std::uint32_t point, std::size_t count) {
  tree_->tree.nearestKSearch(
      static_cast<int>(point), static_cast<int>(count), tree_->indices, tree_->squares_m2);
  tree_->nearest.assign(tree_->indices.begin(), tree_->indices.end());
  return tree_->nearest;
}

}  // namespace hypermap
