// SPDX-License-Identifier: BSD-3-Clause
// Regions against those of PCL's own classes.
#include "segmentation/policies/smooth_regions.hpp"

#include "core/segmentation/office_scene.hpp"

#include <gtest/gtest.h>
#include <pcl/features/impl/normal_3d.hpp>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/impl/region_growing.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// By PCL alone, in the order of `smooth_regions`.
std::vector<PointIndices> regions_of_pcl(const PixelCloud& cloud,
                                         const RegionGrowingOptions& options) {
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& at : cloud.points_in_camera)
    points->push_back({at.x(), at.y(), at.z()});
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(options.normal_neighbours);
  estimation.compute(*normals);

  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(points);
  growing.setInputNormals(normals);
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(static_cast<unsigned int>(options.region_neighbours));
  growing.setSmoothnessThreshold(static_cast<float>(options.angle_threshold_rad));
  growing.setCurvatureThreshold(static_cast<float>(options.curvature_threshold));
  growing.setMinClusterSize(static_cast<pcl::uindex_t>(options.region_min_points));
  std::vector<pcl::PointIndices> found;
  growing.extract(found);
  std::vector<PointIndices> regions;
  regions.reserve(found.size());
  for (const pcl::PointIndices& one : found) {
    PointIndices region(one.indices.begin(), one.indices.end());
    std::ranges::sort(region);
    regions.push_back(std::move(region));
  }
  std::ranges::sort(regions, [](const PointIndices& a, const PointIndices& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return regions;
}

/// Per point its region, -1 in none.
std::vector<int> regions_by_point(const std::vector<PointIndices>& regions,
                                  std::size_t num_points) {
  std::vector<int> of(num_points, -1);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r]) of[i] = static_cast<int>(r);
  }
  return of;
}

/// Share of the points that are in another of our regions than most points of their region by PCL.
double share_told_apart(const std::vector<PointIndices>& ours,
                        const std::vector<PointIndices>& theirs,
                        std::size_t num_points) {
  const std::vector<int> a = regions_by_point(ours, num_points);
  const std::vector<int> b = regions_by_point(theirs, num_points);
  std::map<int, std::map<int, std::size_t>> counts;
  for (std::size_t i = 0; i < num_points; ++i) ++counts[b[i]][a[i]];
  std::size_t num_alike = 0;
  for (const auto& [region, by_ours] : counts) {
    std::size_t most = 0;
    for (const auto& [other, count] : by_ours) {
      if ((other < 0) == (region < 0)) most = std::max(most, count);
    }
    num_alike += most;
  }
  return 1.0 - static_cast<double>(num_alike) / static_cast<double>(num_points);
}

class SmoothRegionsAgainstPcl : public testing::TestWithParam<int> {};

TEST_P(SmoothRegionsAgainstPcl, DifferInLessThanOneOfAHundredPoints) {
  const test::SceneView view = test::office_view(7);
  const PixelCloud cloud = crop(view.frame, test::detection_of(view, GetParam()));
  const RegionGrowingOptions options;
  const auto ours = smooth_regions(cloud, view.frame.camera, options);
  const auto theirs = regions_of_pcl(cloud, options);
  ASSERT_FALSE(theirs.empty());
  EXPECT_EQ(ours.size(), theirs.size());
  EXPECT_LE(share_told_apart(ours, theirs, cloud.pixels.size()), 0.01);
  EXPECT_NEAR(static_cast<double>(ours.front().size()),
              static_cast<double>(theirs.front().size()),
              0.01 * static_cast<double>(theirs.front().size()));
}

INSTANTIATE_TEST_SUITE_P(Office,
                         SmoothRegionsAgainstPcl,
                         testing::Values(static_cast<int>(test::kScreen),
                                         static_cast<int>(test::kKeyboard),
                                         static_cast<int>(test::kChair)));

TEST(SmoothRegions, EndAtACurvatureThatHandsNothingOn) {
  const test::SceneView view = test::office_view(7);
  const PixelCloud cloud = crop(view.frame, test::detection_of(view, test::kScreen));
  RegionGrowingOptions options;
  options.curvature_threshold = 0.005;
  const auto ours = smooth_regions(cloud, view.frame.camera, options);
  EXPECT_LE(share_told_apart(ours, regions_of_pcl(cloud, options), cloud.pixels.size()), 0.01);
  EXPECT_NE(ours, smooth_regions(cloud, view.frame.camera, {}));
}

TEST(SmoothRegions, OfTwoPointsAreNone) {
  const test::SceneView view = test::office_view(7);
  Detection two;
  two.box_px = {300, 200, 302, 201};
  const PixelCloud cloud = crop(view.frame, two);
  ASSERT_EQ(cloud.pixels.size(), 2U);
  RegionGrowingOptions options;
  options.region_min_points = 1;
  EXPECT_TRUE(smooth_regions(cloud, view.frame.camera, options).empty());
}

}  // namespace
}  // namespace hypermap
