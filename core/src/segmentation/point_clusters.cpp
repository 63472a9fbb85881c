// SPDX-License-Identifier: BSD-3-Clause
#include "point_clusters.hpp"

// The templates themselves: PCL's libraries hold them for every type of point, and loading those
// takes longer than a short run of a program.
#include <pcl/filters/impl/filter_indices.hpp>
#include <pcl/filters/impl/statistical_outlier_removal.hpp>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/impl/extract_clusters.hpp>

#include <algorithm>
#include <numeric>

namespace hypermap {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Tree = pcl::search::KdTree<pcl::PointXYZ>;

Cloud::Ptr to_cloud(std::span<const Eigen::Vector3f> points) {
  auto cloud = pcl::make_shared<Cloud>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    cloud->push_back(pcl::PointXYZ(point.x(), point.y(), point.z()));
  }
  return cloud;
}

PointIndices ascending(const pcl::Indices& indices) {
  PointIndices out(indices.begin(), indices.end());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<PointIndices> largest_first(const std::vector<pcl::PointIndices>& clusters) {
  std::vector<PointIndices> out;
  out.reserve(clusters.size());
  for (const pcl::PointIndices& cluster : clusters) out.push_back(ascending(cluster.indices));
  std::sort(out.begin(), out.end(), [](const PointIndices& a, const PointIndices& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return out;
}

}  // namespace

PointIndices statistical_inliers(std::span<const Eigen::Vector3f> points,
                                 int neighbours,
                                 double stddev) {
  if (points.size() <= static_cast<std::size_t>(neighbours)) {
    PointIndices all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(to_cloud(points));
  filter.setMeanK(neighbours);
  filter.setStddevMulThresh(stddev);
  pcl::Indices kept;
  filter.filter(kept);
  return ascending(kept);
}

std::vector<PointIndices> euclidean_clusters(std::span<const Eigen::Vector3f> points,
                                             double gap_m,
                                             int min_points,
                                             int max_points) {
  if (points.empty()) return {};
  const Cloud::Ptr cloud = to_cloud(points);
  const auto tree = pcl::make_shared<Tree>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(gap_m);
  extraction.setMinClusterSize(static_cast<pcl::uindex_t>(min_points));
  extraction.setMaxClusterSize(static_cast<pcl::uindex_t>(max_points));
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return largest_first(clusters);
}

}  // namespace hypermap
