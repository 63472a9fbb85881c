// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/reading_check.hpp"

#include "sequence_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace hypermap {
namespace {

constexpr double kTolerance = 0.02;  // of the distance: twice what depth cameras are off at 3 m
constexpr int kColumns = 32;         // samples in a row of the image
constexpr int kMinStepPx = 4;
constexpr std::size_t kMinSamples = 100;
constexpr double kMinOverlap = 0.25;  // fewer shared points count as if there were so many
constexpr std::size_t kMinPairs = 3;
constexpr double kMinShare = 0.5;
constexpr double kMinGain = 0.2;
constexpr double kMinWinningPairs = 0.75;
constexpr double kNearestMedianM = 0.2;  // depth cameras measure from there to here
constexpr double kFarthestMedianM = 8.0;
// An eighth: of 16 bits that were rotated to the left by three, when none of the upper three is
// set.
constexpr std::array kTriedDepthFactors{0.001, 0.1, 0.125, 0.2, 5.0, 10.0, 1000.0};
constexpr std::array kTriedDirections{PoseDirection::kCameraToWorld, PoseDirection::kWorldToCamera};
constexpr std::array kTriedAxes{CameraAxes::kOptical, CameraAxes::kOpenGl, CameraAxes::kRobot};

InputFromCamera optical_pose(const InputFromCamera& written, const FrameReading& reading) {
  DatasetDescription description;
  description.pose_direction = reading.pose_direction;
  description.camera_axes = reading.camera_axes;
  return as_optical(written, description);
}

/// The pose as it stood in the file.
InputFromCamera written_pose(const RgbdFrame& frame, const FrameReading& taken) {
  const Eigen::Isometry3d given_from_optical =
      optical_pose(InputFromCamera(), {.camera_axes = taken.camera_axes}).isometry();
  const Eigen::Isometry3d given = frame.map_from_camera.isometry() * given_from_optical.inverse();
  return InputFromCamera(taken.pose_direction == PoseDirection::kWorldToCamera ? given.inverse()
                                                                               : given);
}

/// 0 where nothing was measured.
double depth_at(const RgbdFrame& frame, int u, int v) {
  const auto depth_m = static_cast<double>(frame.depth_m.at(u, v));
  return std::isfinite(depth_m) && depth_m > 0.0 ? depth_m : 0.0;
}

int step_px(const RgbdFrame& frame) {
  return std::max(kMinStepPx, frame.camera.width_px / kColumns);
}

/// Calls `visit` with column, row and depth of samples all over the image.
template <class Visit>
void for_each_sample(const RgbdFrame& frame, const Visit& visit) {
  const int step = step_px(frame);
  for (int v = step / 2; v < frame.depth_m.height_px(); v += step) {
    for (int u = step / 2; u < frame.depth_m.width_px(); u += step) {
      const double depth_m = depth_at(frame, u, v);
      if (depth_m > 0.0) visit(u, v, depth_m);
    }
  }
}

/// What became of the points of a first frame in a second one.
struct PointCounts {
  std::size_t num_samples = 0;
  std::size_t num_compared = 0;  ///< Measured by both; or behind the second camera, which is none.
  std::size_t num_equal = 0;

  [[nodiscard]] double share() const {
    const double compared =
        std::max(static_cast<double>(num_compared), kMinOverlap * static_cast<double>(num_samples));
    return compared > 0.0 ? static_cast<double>(num_equal) / compared : 0.0;
  }
};

/// The distance that `frame` measured where `point` would be seen; 0 where it did not.
double measured_along(const RgbdFrame& frame, const PointInCamera& point) {
  const auto pixel = frame.camera.project(point);
  const double width = frame.depth_m.width_px();
  const double height = frame.depth_m.height_px();
  const bool is_inside = pixel && pixel->u_px >= 0.0 && pixel->u_px <= width - 1.0 &&
                         pixel->v_px >= 0.0 && pixel->v_px <= height - 1.0;
  if (!is_inside) return 0.0;
  return depth_at(frame,
                  static_cast<int>(std::lround(pixel->u_px)),
                  static_cast<int>(std::lround(pixel->v_px)));
}

PointCounts count_points(const FramePair& pair,
                         const Eigen::Isometry3d& second_from_first,
                         double depth_factor) {
  PointCounts counts;
  for_each_sample(pair.first, [&](int u, int v, double depth_m) {
    ++counts.num_samples;
    const PointInCamera point{second_from_first *
                              pair.first.camera.unproject(u, v, depth_factor * depth_m).xyz};
    const double measured_m = depth_factor * measured_along(pair.second, point);
    if (point.xyz.z() > 0.0 && measured_m == 0.0) return;
    ++counts.num_compared;
    counts.num_equal += std::abs(point.xyz.z() - measured_m) <= kTolerance * measured_m ? 1U : 0U;
  });
  return counts;
}

PointCounts count_points(const FramePair& pair,
                         const FrameReading& taken,
                         const FrameReading& other) {
  const auto pose = [&](const RgbdFrame& frame) {
    return optical_pose(written_pose(frame, taken), other).isometry();
  };
  return count_points(pair,
                      pose(pair.second).inverse() * pose(pair.first),
                      taken.depth_units_per_m / other.depth_units_per_m);
}

double median_depth_m(std::span<const FramePair> pairs) {
  std::vector<double> depths;
  for (const FramePair& pair : pairs) {
    for_each_sample(pair.first, [&](int, int, double depth_m) { depths.push_back(depth_m); });
  }
  if (depths.empty()) return 0.0;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

/// Those that differ from `taken` by the poses alone or by the depth alone.
std::vector<FrameReading> other_readings(const FrameReading& taken, double median_m) {
  std::vector<FrameReading> others;
  others.reserve(kTriedDirections.size() * kTriedAxes.size() + kTriedDepthFactors.size());
  for (const PoseDirection direction : kTriedDirections) {
    for (const CameraAxes axes : kTriedAxes) {
      FrameReading other = taken;
      other.pose_direction = direction;
      other.camera_axes = axes;
      if (other != taken) others.push_back(other);
    }
  }
  for (const double factor : kTriedDepthFactors) {
    const double median_then_m = factor * median_m;
    if (median_then_m < kNearestMedianM || median_then_m > kFarthestMedianM) continue;
    FrameReading other = taken;
    other.depth_units_per_m = taken.depth_units_per_m / factor;
    others.push_back(other);
  }
  return others;
}

using Shares = std::vector<double>;  // of each pair

Shares shares_of(std::span<const FramePair> pairs,
                 const FrameReading& taken,
                 const FrameReading& other) {
  Shares shares;
  for (const FramePair& pair : pairs) {
    const PointCounts counts = count_points(pair, taken, other);
    if (counts.num_samples >= kMinSamples) shares.push_back(counts.share());
  }
  return shares;
}

double mean(const Shares& shares) {
  double sum = 0.0;
  for (const double share : shares) sum += share;
  return shares.empty() ? 0.0 : sum / static_cast<double>(shares.size());
}

bool is_better(const Shares& other, const Shares& taken) {
  std::size_t num_won = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) num_won += other[i] > taken[i] ? 1U : 0U;
  const bool wins =
      static_cast<double>(num_won) >= kMinWinningPairs * static_cast<double>(taken.size());
  return wins && mean(other) >= kMinShare && mean(other) >= mean(taken) + kMinGain;
}

}  // namespace

ReadingCheck check_reading(std::span<const FramePair> pairs, const FrameReading& taken) {
  const Shares now = shares_of(pairs, taken, taken);
  ReadingCheck check{.num_pairs = now.size(), .taken = {taken, mean(now)}, .better = std::nullopt};
  if (now.size() < kMinPairs) return check;
  for (const FrameReading& other : other_readings(taken, median_depth_m(pairs))) {
    const Shares shares = shares_of(pairs, taken, other);
    const double share = mean(shares);
    if (!is_better(shares, now) || (check.better && check.better->share >= share)) continue;
    check.better = ReadingAgreement{other, share};
  }
  return check;
}

}  // namespace hypermap
