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
constexpr int kVerticalTries = 40;
constexpr int kFreeTries = 40;
constexpr int kRefinements = 3;
/// Floors, tables and walls are level or upright; other planes have to be clearly better.
constexpr double kFreeHandicap = 0.75;
/// Cosine of 3 degrees, what the up axis of a map may be off.
constexpr float kLeanCos = 0.9986F;
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

/// The best of planes that were tried.
class Contest {
 public:
  Contest(const Points& points, const ForegroundOptions& options)
      : points_(points), options_(options) {}

  /// `handicap` times its support is what counts.
  void consider(const Plane& plane, double handicap = 1.0) {
    const double value = handicap * static_cast<double>(support(plane, points_, options_));
    if (value <= best_value_) return;
    best_ = plane;
    best_value_ = value;
    handicap_ = handicap;
  }

  /// Moves the best plane into the middle of its points while that gains support. To turn a level
  /// or upright plane by more than the map may lean has to gain more: it may join two parallel
  /// faces.
  void refine() {
    const Eigen::Vector3f normal = best_.normal;
    for (int round = 0; round < kRefinements; ++round) {
      const Plane next = refined(best_, points_, options_);
      const bool turns = std::abs(next.normal.dot(normal)) < kLeanCos;
      consider(next, turns ? kFreeHandicap : handicap_);
    }
  }

  [[nodiscard]] const Plane& best() const { return best_; }

 private:
  const Points& points_;
  const ForegroundOptions& options_;
  Plane best_;
  double best_value_ = 0.0;
  double handicap_ = 1.0;
};

Plane best_plane(const Points& points,
                 const Eigen::Vector3f& up_in_camera,
                 const ForegroundOptions& options,
                 Dice& dice) {
  Contest contest(points, options);
  const auto any_point = [&]() -> const Eigen::Vector3f& {
    return points[dice.below(points.size())];
  };
  for (int i = 0; i < kHorizontalTries; ++i) {
    contest.consider({up_in_camera, -up_in_camera.dot(any_point())});
  }
  for (int i = 0; i < kVerticalTries; ++i) {
    const Eigen::Vector3f& a = any_point();
    const auto plane = plane_through(a, any_point(), a + up_in_camera);
    if (plane) contest.consider(*plane);
  }
  for (int i = 0; i < kFreeTries; ++i) {
    const Eigen::Vector3f& a = any_point();
    const Eigen::Vector3f& b = any_point();
    const auto plane = plane_through(a, b, any_point());
    if (plane) contest.consider(*plane, kFreeHandicap);
  }
  contest.refine();
  return contest.best();
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
  // What is left of a plane at twice its thickness is its own noise, not another plane.
  ForegroundOptions wide = options;
  wide.plane_thickness_m *= 2.0;
  wide.noise_factor *= 2.0;
  std::vector<Plane> planes;
  Dice dice;
  while (planes.size() < static_cast<std::size_t>(options.max_planes) && points.size() >= least) {
    const Plane plane = best_plane(points, up_in_camera, options, dice);
    if (support(plane, points, options) < least) break;
    planes.push_back(plane);
    std::erase_if(points, [&](const auto& point) { return lies_on(plane, point, wide); });
  }
  return planes;
}

}  // namespace hypermap
