// SPDX-License-Identifier: BSD-3-Clause
#include "pose_drift.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

constexpr std::uint64_t kDriftStream = 0x6472696674;  // which numbers: "drift"
constexpr std::uint64_t kWhiteStream = 0x7768697465;  // "white"
constexpr double kPositionM = 0.01;
constexpr double kHeadingRad = 0.1 * 0.017453292519943295;
constexpr double kMetresPerRad = 0.3;

double way_m(const MapFromCamera& from, const MapFromCamera& to) {
  const Eigen::Isometry3d step = from.isometry().inverse() * to.isometry();
  return step.translation().norm() +
         kMetresPerRad * std::abs(Eigen::AngleAxisd(step.linear()).angle());
}

}  // namespace

std::vector<MapFromCamera> drifted(std::span<const MapFromCamera> true_poses,
                                   double scale,
                                   std::uint64_t seed) {
  std::vector<MapFromCamera> recorded(true_poses.begin(), true_poses.end());
  if (scale == 0.0) return recorded;
  CounterRng random(seed, kDriftStream);
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  double heading = 0.0;
  for (std::size_t i = 1; i < recorded.size(); ++i) {
    const double spread = scale * std::sqrt(way_m(true_poses[i - 1], true_poses[i]));
    offset += spread * kPositionM * Eigen::Vector2d(random.normal(), random.normal());
    heading += spread * kHeadingRad * random.normal();
    Eigen::Isometry3d pose = true_poses[i].isometry();
    pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * pose.linear();
    pose.translation().head<2>() += offset;
    recorded[i] = MapFromCamera(pose);
  }
  return recorded;
}

MapFromCamera with_white_noise(const MapFromCamera& pose,
                               double stddev_m,
                               double stddev_rad,
                               std::uint64_t seed,
                               std::uint64_t frame) {
  if (stddev_m == 0.0 && stddev_rad == 0.0) return pose;
  CounterRng random(seed, kWhiteStream, frame);
  Eigen::Vector3d offset;
  Eigen::Vector3d turn;
  for (double& coordinate : offset) coordinate = stddev_m * random.normal();
  for (double& angle : turn) angle = stddev_rad * random.normal();
  Eigen::Isometry3d moved = pose.isometry();
  moved.translation() += offset;
  const double angle = turn.norm();
  if (angle > 0.0) moved.linear() = Eigen::AngleAxisd(angle, turn / angle) * moved.linear();
  return MapFromCamera(moved);
}

}  // namespace hypermap
