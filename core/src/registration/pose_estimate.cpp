// SPDX-License-Identifier: BSD-3-Clause
#include "registration/pose_estimate.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "registration/rotation_vector.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kNumIterations = 6;
constexpr std::size_t kMinMatches = 100;
constexpr double kMinMatchedShare = 0.1;
/// Neighbouring points err alike: all of a frame count as so many independent ones.
constexpr double kNumIndependent = 1000.0;
/// Of the points, in units of that of the given pose: less is the planes' own error, and from so
/// much on the points determine the direction.
constexpr double kMinInformation = 0.1;
constexpr double kDeterminingInformation = 1.0;
constexpr int kMinDirections = 3;
constexpr double kTukey = 4.685;  // 95 % efficient with normal errors
constexpr double kMedianToStddev = 1.4826;
/// Surfaces are so thick by wrong poses, and by the noise of the sensor.
constexpr double kThicknessM = 0.004;
constexpr double kThicknessPerNoise = 1.2;
constexpr double kMaxPenalty = 9.0;  // of a point at no plane, in variances

/// A point's distance from its plane.
struct Match {
  Eigen::Vector3d normal;
  Eigen::Vector3d from_camera_m;  ///< The point, from the camera's place.
  double distance_m = 0.0;
  double stddev_m = 0.0;
};

std::vector<Match> match(std::span<const OrientedPoint> points_in_camera,
                         const Eigen::Isometry3d& pose,
                         const SurfaceModel& surfaces) {
  std::vector<Match> matches;
  matches.reserve(points_in_camera.size());
  for (const OrientedPoint& point : points_in_camera) {
    const Eigen::Vector3d from_camera_m = pose.linear() * point.place_m;
    const Eigen::Vector3d place_m = from_camera_m + pose.translation();
    const double noise_m = axial_noise_m(point.place_m.z());
    const auto plane = surfaces.plane_at({place_m, pose.linear() * point.normal},
                                         kThicknessM + kThicknessPerNoise * noise_m);
    if (!plane) continue;
    matches.push_back({.normal = plane->normal,
                       .from_camera_m = from_camera_m,
                       .distance_m = plane->normal.dot(place_m - plane->point_m),
                       .stddev_m = noise_m + 0.5 * plane->stddev_m});
  }
  return matches;
}

double normalized(const Match& match) {
  return match.distance_m / match.stddev_m;
}

/// Standard deviation of the normalised distances, by their median.
double robust_spread(std::span<const Match> matches) {
  std::vector<double> sizes;
  sizes.reserve(matches.size());
  for (const Match& each : matches) sizes.push_back(std::abs(normalized(each)));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kMedianToStddev * *middle, 1.0);
}

double tukey_weight(double normalized_distance, double spread) {
  const double ratio = normalized_distance / (kTukey * spread);
  const double rest = 1.0 - ratio * ratio;
  return rest > 0.0 ? rest * rest : 0.0;
}

/// Penalty of a pose: mean squared distance in variances, bounded, points at no plane included.
double penalty(std::span<const Match> matches, std::size_t num_points) {
  double sum = kMaxPenalty * static_cast<double>(num_points - matches.size());
  for (const Match& each : matches) {
    sum += std::min(normalized(each) * normalized(each), kMaxPenalty);
  }
  return sum / static_cast<double>(num_points);
}

double rms_m(std::span<const Match> matches, double spread) {
  double squares_m2 = 0.0;
  double weights = 0.0;
  for (const Match& each : matches) {
    const double weight = tukey_weight(normalized(each), spread);
    squares_m2 += weight * each.distance_m * each.distance_m;
    weights += weight;
  }
  return weights > 0.0 ? std::sqrt(squares_m2 / weights) : 0.0;
}

/// Normal equations of a change (rotation about the camera's place, then translation).
struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

NormalEquations normal_equations(std::span<const Match> matches) {
  NormalEquations equations;
  const double spread = robust_spread(matches);
  for (const Match& each : matches) {
    const double weight = tukey_weight(normalized(each), spread) / (each.stddev_m * each.stddev_m);
    Vector6d slope;
    slope << each.from_camera_m.cross(each.normal), each.normal;
    equations.information.selfadjointView<Eigen::Lower>().rankUpdate(slope, weight);
    equations.gradient += weight * each.distance_m * slope;
  }
  equations.information = equations.information.selfadjointView<Eigen::Lower>();
  const double share =
      std::min(1.0, kNumIndependent / static_cast<double>(matches.size())) / (spread * spread);
  equations.information *= share;
  equations.gradient *= share;
  return equations;
}

/// A change of the given pose, in its sigmas.
struct Change {
  Vector6d in_sigmas = Vector6d::Zero();
  int num_directions = 0;
};

/// The change that is most probable for the matches at `current`.
Change solve(const NormalEquations& equations, const Vector6d& current, const Vector6d& sigmas) {
  const Matrix6d information = sigmas.asDiagonal() * equations.information * sigmas.asDiagonal();
  const Vector6d pull = information * current - sigmas.asDiagonal() * equations.gradient;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information);
  Change change;
  for (int i = 0; i < 6; ++i) {
    const double size = solver.eigenvalues()[i];
    if (size < kMinInformation) continue;
    const Vector6d direction = solver.eigenvectors().col(i);
    change.in_sigmas += direction * (direction.dot(pull) / (size + 1.0));
    if (size >= kDeterminingInformation) ++change.num_directions;
  }
  return change;
}

Eigen::Isometry3d changed(const Eigen::Isometry3d& given, const Vector6d& change) {
  Eigen::Isometry3d pose = given;
  pose.linear() = rotation_of(change.head<3>()) * given.linear();
  pose.translation() += change.tail<3>();
  return pose;
}

bool are_enough(std::size_t num_matches, std::size_t num_points) {
  return num_matches >= kMinMatches &&
         static_cast<double>(num_matches) >= kMinMatchedShare * static_cast<double>(num_points);
}

PoseEstimate refused(const Eigen::Isometry3d& given, PoseCorrection correction, PoseOutcome why) {
  correction.outcome = why;
  return {.model_from_camera = given, .correction = correction};
}

}  // namespace

PoseEstimate estimate_pose(std::span<const OrientedPoint> points_in_camera,
                           const Eigen::Isometry3d& given,
                           const SurfaceModel& surfaces,
                           const PoseRefinementOptions& options) {
  Vector6d sigmas;
  sigmas << Eigen::Vector3d::Constant(options.sigma_rad),
      Eigen::Vector3d::Constant(options.sigma_m);
  PoseCorrection correction;
  Vector6d change = Vector6d::Zero();  // rotation, then translation, from `given`
  auto matches = match(points_in_camera, given, surfaces);
  const double penalty_before = penalty(matches, std::max<std::size_t>(points_in_camera.size(), 1));
  for (int i = 0; i < kNumIterations; ++i) {
    correction.num_points = matches.size();
    if (!are_enough(matches.size(), points_in_camera.size())) {
      return refused(given, correction, PoseOutcome::kTooFewPoints);
    }
    const Vector6d current = change.cwiseQuotient(sigmas);
    const Change next = solve(normal_equations(matches), current, sigmas);
    correction.num_directions = next.num_directions;
    if (next.num_directions < kMinDirections) {
      return refused(given, correction, PoseOutcome::kAmbiguous);
    }
    change = next.in_sigmas.cwiseProduct(sigmas);
    matches = match(points_in_camera, changed(given, change), surfaces);
  }
  if (change.tail<3>().norm() > options.max_translation_m ||
      change.head<3>().norm() > options.max_rotation_rad) {
    return refused(given, correction, PoseOutcome::kTooLarge);
  }
  if (!are_enough(matches.size(), points_in_camera.size()) ||
      penalty(matches, points_in_camera.size()) > penalty_before) {
    return refused(given, correction, PoseOutcome::kNoBetter);
  }
  correction.outcome = PoseOutcome::kRefined;
  correction.num_points = matches.size();
  correction.rms_m = rms_m(matches, robust_spread(matches));
  return {.model_from_camera = changed(given, change), .correction = correction};
}

}  // namespace hypermap
