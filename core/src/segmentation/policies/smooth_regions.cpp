// SPDX-License-Identifier: BSD-3-Clause
#include "smooth_regions.hpp"

#include "image_neighbours.hpp"

// The template itself, as point_clusters.cpp says.
#include <pcl/features/impl/normal_3d.hpp>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace hypermap {
namespace {

struct SurfacePoint {
  Eigen::Vector3f normal;
  float curvature = 0.0F;
};

/// Each point of a cloud, and which are beside it.
struct Surface {
  std::vector<SurfacePoint> points;
  std::size_t num_beside = 0;
  PointIndices beside;  ///< Of one point after the other.

  [[nodiscard]] std::span<const std::uint32_t> beside_of(std::uint32_t point) const {
    return std::span(beside).subspan(point * num_beside, num_beside);
  }
};

Surface surface_of(const PixelCloud& cloud,
                   const PinholeCamera& camera,
                   const RegionGrowingOptions& options) {
  const std::size_t size = cloud.pixels.size();
  pcl::PointCloud<pcl::PointXYZ> points;
  points.reserve(size);
  for (const Eigen::Vector3f& at : cloud.points_in_camera)
    points.push_back({at.x(), at.y(), at.z()});
  const auto limited = [&](int count) { return std::min(static_cast<std::size_t>(count), size); };
  const std::size_t num_fitted = limited(options.normal_neighbours);
  Surface surface{.points = std::vector<SurfacePoint>(size),
                  .num_beside = limited(options.region_neighbours),
                  .beside = {}};
  surface.beside.reserve(size * surface.num_beside);
  const auto [num_first, num_near] = std::minmax(num_fitted, surface.num_beside);
  ImageNeighbours neighbours(cloud, camera);
  pcl::Indices fitted;
  for (std::uint32_t i = 0; i < size; ++i) {
    const auto near = neighbours.nearest(i, num_near, num_first);
    const auto beside = near.first(surface.num_beside);
    surface.beside.insert(surface.beside.end(), beside.begin(), beside.end());
    fitted.assign(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(num_fitted));
    Eigen::Vector4f plane;
    (void)pcl::computePointNormal(points, fitted, plane, surface.points[i].curvature);
    surface.points[i].normal = plane.head<3>();
  }
  return surface;
}

/// Positions of points, the flattest first, of equals in their order.
PointIndices flattest_first(const std::vector<SurfacePoint>& surface) {
  std::vector<std::pair<float, std::uint32_t>> order;
  order.reserve(surface.size());
  for (std::uint32_t i = 0; i < surface.size(); ++i) order.emplace_back(surface[i].curvature, i);
  std::ranges::sort(order);
  PointIndices points(order.size());
  std::ranges::transform(order, points.begin(), &std::pair<float, std::uint32_t>::second);
  return points;
}

class RegionGrowth {
 public:
  RegionGrowth(const Surface& surface, const RegionGrowingOptions& options)
      : surface_(surface),
        min_cosine_(static_cast<float>(std::cos(options.angle_threshold_rad))),
        max_curvature_(static_cast<float>(options.curvature_threshold)),
        region_of_(surface.points.size(), kNoRegion) {}

  /// A new region of all points that `seed` leads to and that no region has yet. Boundary: none
  /// when one has the seed.
  void grow(std::uint32_t seed) {
    if (region_of_[seed] != kNoRegion) return;
    const auto region = static_cast<std::uint32_t>(sizes_.size());
    sizes_.push_back(1);
    region_of_[seed] = region;
    open_.push_back(seed);
    while (!open_.empty()) {
      const std::uint32_t from = open_.back();
      open_.pop_back();
      const Eigen::Vector3f& normal = surface_.points[from].normal;
      for (const std::uint32_t to : surface_.beside_of(from)) {
        if (region_of_[to] != kNoRegion) continue;
        const SurfacePoint& next = surface_.points[to];
        if (std::abs(next.normal.dot(normal)) < min_cosine_) continue;
        region_of_[to] = region;
        ++sizes_.back();
        if (next.curvature <= max_curvature_) open_.push_back(to);
      }
    }
  }

  /// The points of each region in their order, by the order in which the regions began.
  [[nodiscard]] std::vector<PointIndices> regions() const {
    std::vector<PointIndices> out(sizes_.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i].reserve(sizes_[i]);
    for (std::uint32_t i = 0; i < region_of_.size(); ++i) out[region_of_[i]].push_back(i);
    return out;
  }

 private:
  static constexpr std::uint32_t kNoRegion = std::numeric_limits<std::uint32_t>::max();

  const Surface& surface_;
  float min_cosine_;
  float max_curvature_;
  std::vector<std::uint32_t> region_of_;
  std::vector<std::size_t> sizes_;
  PointIndices open_;
};

}  // namespace

std::vector<PointIndices> smooth_regions(const PixelCloud& cloud,
                                         const PinholeCamera& camera,
                                         const RegionGrowingOptions& options) {
  constexpr std::size_t kPointsOfPlane = 3;
  if (cloud.pixels.size() < kPointsOfPlane) return {};
  const Surface surface = surface_of(cloud, camera, options);
  RegionGrowth growth(surface, options);
  for (const std::uint32_t seed : flattest_first(surface.points)) growth.grow(seed);
  std::vector<PointIndices> regions = growth.regions();
  std::erase_if(regions, [&](const PointIndices& region) {
    return std::cmp_less(region.size(), options.region_min_points);
  });
  std::ranges::sort(regions, [](const PointIndices& a, const PointIndices& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return regions;
}

}  // namespace hypermap
