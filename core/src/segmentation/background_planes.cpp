// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/background_planes.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace hypermap {
namespace {

constexpr std::size_t kMaxSamples = 500;
constexpr int kHorizontalTries = 24;
constexpr int kFreeTries = 60;
constexpr std::size_t kLeastSupport = 20;

using Points = std::vector<Eigen::Vector3f>;

/// Fixed pseudo random numbers (SplitMix64): the same window gives the same planes.
class Dice {
 public:
  std::size_t below(std::size_t count) {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<std::size_t>((z ^ (z >> 31U)) % count);
  }

 private:
  std::uint64_t state_ = 0;
};

/// Evenly chosen measured points outside the box.
Points surroundings(const DepthWindow& window) {
  std::vector<std::pair<int, int>> cells;
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      if (!window.tolerant_box.contains(x, y) && window.depth_m[window.cell(x, y)] > 0.0F)
        cells.emplace_back(x, y);
    }
  }
  Points points;
  const std::size_t count = std::min(cells.size(), kMaxSamples);
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = cells[i * cells.size() / count];
    points.push_back(window.point_in_camera(x, y));
  }
  return points;
}

std::optional<Plane> plane_through(const Eigen::Vector3f& a,
                                   const Eigen::Vector3f& b,
                                   const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const float length = normal.norm();
  if (!(length > 1e-6F)) return std::nullopt;
  return Plane{normal / length, -normal.dot(a) / length};
}

std::size_t support(const Plane& plane, const Points& points, const ForegroundOptions& options) {
  return static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(), [&](const auto& p) { return lies_on(plane, p, options); }));
}

/// Least squares through the points on `plane`.
Plane refined(const Plane& plane, const Points& points, const ForegroundOptions& options) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (const Eigen::Vector3f& point : points) {
    if (!lies_on(plane, point, options)) continue;
    const Eigen::Vector3d exact = point.cast<double>();
    mean += exact;
    moments += exact * exact.transpose();
    count += 1.0;
  }
  if (count < 3.0) return plane;
  mean /= count;
  const Eigen::Matrix3d covariance = moments / count - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return {normal.cast<float>(), static_cast<float>(-normal.dot(mean))};
}

Plane best_plane(const Points& points,
                 const Eigen::Vector3f& up_in_camera,
                 const ForegroundOptions& options,
                 Dice& dice) {
  Plane best;
  std::size_t best_support = 0;
  const auto consider = [&](const Plane& plane) {
    const std::size_t supported = support(plane, points, options);
    if (supported <= best_support) return;
    best = plane;
    best_support = supported;
  };
  for (int i = 0; i < kHorizontalTries; ++i) {
    const Eigen::Vector3f& point = points[dice.below(points.size())];
    consider({up_in_camera, -up_in_camera.dot(point)});
  }
  for (int i = 0; i < kFreeTries; ++i) {
    const Eigen::Vector3f& a = points[dice.below(points.size())];
    const Eigen::Vector3f& b = points[dice.below(points.size())];
    const Eigen::Vector3f& c = points[dice.below(points.size())];
    if (const std::optional<Plane> plane = plane_through(a, b, c)) consider(*plane);
  }
  for (int round = 0; round < 3; ++round) consider(refined(best, points, options));
  return best;
}

}  // namespace

bool lies_on(const Plane& plane,
             const Eigen::Vector3f& point_in_camera,
             const ForegroundOptions& options) {
  // Noise moves a point along its ray; only the part across the plane counts.
  const float across = std::abs(plane.normal.dot(point_in_camera)) / point_in_camera.z();
  const auto noise_m = static_cast<float>(options.noise_factor *
                                          axial_noise_m(static_cast<double>(point_in_camera.z())));
  return std::abs(plane.distance_m(point_in_camera)) <=
         static_cast<float>(options.plane_thickness_m) + noise_m * across;
}

std::vector<Plane> background_planes(const DepthWindow& window,
                                     const Eigen::Vector3f& up_in_camera,
                                     const ForegroundOptions& options) {
  Points points = surroundings(window);
  const auto least = std::max(
      kLeastSupport,
      static_cast<std::size_t>(options.plane_min_share * static_cast<double>(points.size())));
  std::vector<Plane> planes;
  Dice dice;
  while (planes.size() < static_cast<std::size_t>(options.max_planes) && points.size() >= least) {
    const Plane plane = best_plane(points, up_in_camera, options, dice);
    if (support(plane, points, options) < least) break;
    planes.push_back(plane);
    std::erase_if(points, [&](const auto& point) { return lies_on(plane, point, options); });
  }
  return planes;
}

}  // namespace hypermap
