// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/dataset/reading_check.hpp"
#include "hypermap/io/dataset/up_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxPairs = 6;
constexpr std::array<std::size_t, 4> kGaps{1, 3, 9, 27};
constexpr double kMinTurnRad = 5.0 * std::numbers::pi / 180.0;
constexpr double kMinLookAroundRad = 15.0 * std::numbers::pi / 180.0;
constexpr double kMaxTiltRad = 50.0 * std::numbers::pi / 180.0;
constexpr double kMinBetterTiltRad = 45.0 * std::numbers::pi / 180.0;
constexpr double kOppositeCosine = -0.99;
constexpr double kMinMoreTurning = 1.5;
constexpr double kMinCommonUp = 0.6;  // length of the mean of unit vectors

double turn_rad(const RgbdFrame& a, const RgbdFrame& b) {
  return Eigen::AngleAxisd(a.map_from_camera.isometry().linear().transpose() *
                           b.map_from_camera.isometry().linear())
      .angle();
}

/// Whether the camera turned from pair to pair: one that does not may look straight up or down.
bool looks_around(std::span<const FramePair> pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const FramePair& pair) {
    return turn_rad(pairs.front().first, pair.first) >= kMinLookAroundRad;
  });
}

/// The first of the later frames towards which the camera has turned, else the last of them.
std::optional<RgbdFrame> partner_of(const RgbdFrame& first,
                                    std::size_t index,
                                    const DatasetReader& dataset) {
  std::optional<RgbdFrame> partner;
  for (const std::size_t gap : kGaps) {
    if (index + gap >= dataset.size()) break;
    auto frame = dataset.read(index + gap);
    if (!frame) continue;
    partner = std::move(*frame);
    if (turn_rad(first, *partner) >= kMinTurnRad) break;
  }
  return partner;
}

std::string_view name_of(PoseDirection direction) {
  return direction == PoseDirection::kCameraToWorld ? "camera_to_world" : "world_to_camera";
}

std::string_view name_of(CameraAxes axes) {
  switch (axes) {
    case CameraAxes::kOptical:
      return "optical";
    case CameraAxes::kOpenGl:
      return "opengl";
    case CameraAxes::kRobot:
      return "robot";
  }
  return "optical";
}

void add_field(std::string& text, std::string_view name, std::string_view value) {
  text += text.empty() ? "" : ", ";
  text.append(name).append(": ").append(value);
}

/// The fields in which two readings differ, as a description has them.
std::string fields_of(const FrameReading& other, const FrameReading& taken) {
  std::string text;
  if (other.pose_direction != taken.pose_direction)
    add_field(text, "pose_direction", name_of(other.pose_direction));
  if (other.camera_axes != taken.camera_axes)
    add_field(text, "camera_axes", name_of(other.camera_axes));
  if (other.depth_units_per_m == 8.0 * taken.depth_units_per_m)
    add_field(text, "depth_rotated_bits", "3");
  else if (other.depth_units_per_m != taken.depth_units_per_m)
    add_field(text, "depth_scale", json_number(other.depth_units_per_m));
  return text;
}

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

std::string degrees(double angle_rad) {
  return std::to_string(std::lround(angle_rad * 180.0 / std::numbers::pi)) + " degrees";
}

/// How much the camera turned about `axis` from pair to pair, as a sum of squares.
double turning_about(const Eigen::Vector3d& axis, std::span<const FramePair> pairs) {
  double sum = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::AngleAxisd turn(
        pairs[i].first.map_from_camera.isometry().linear() *
        pairs[i - 1].first.map_from_camera.isometry().linear().transpose());
    sum += std::pow(turn.angle() * turn.axis().dot(axis), 2);
  }
  return sum;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Finding finding(std::string what, std::string field) {
  return {.error = {.code = ErrorCode::kInvalidArgument,
                    .what = std::move(what),
                    .field = std::move(field)}};
}

}  // namespace

std::vector<FramePair> moving_pairs(const DatasetReader& dataset) {
  std::vector<FramePair> pairs;
  pairs.reserve(kMaxPairs);
  for (std::size_t i = 0; i < kMaxPairs && dataset.size() > 1; ++i) {
    const std::size_t index = i * (dataset.size() - 1) / kMaxPairs;
    if (i > 0 && index == (i - 1) * (dataset.size() - 1) / kMaxPairs) continue;
    auto first = dataset.read(index);
    if (!first) continue;
    auto second = partner_of(*first, index, dataset);
    if (second) pairs.push_back({std::move(*first), std::move(*second)});
  }
  return pairs;
}

std::optional<Finding> find_misreading(std::span<const FramePair> pairs,
                                       const FrameReading& taken) {
  const ReadingCheck check = check_reading(pairs, taken);
  if (!check.better) return std::nullopt;
  const std::string fields = fields_of(check.better->reading, taken);
  return finding("explains the images better: with \"" + fields + "\" in the description " +
                     percent(check.better->share) + " of the points of " +
                     std::to_string(check.num_pairs) + " pairs of frames agree, now " +
                     percent(check.taken.share),
                 fields.substr(0, fields.find(':')));
}

std::optional<Finding> find_wrong_up(std::span<const FramePair> pairs,
                                     const MapFromInput& map_from_input) {
  Eigen::Vector3d camera_up = Eigen::Vector3d::Zero();
  for (const FramePair& pair : pairs)
    camera_up -= pair.first.map_from_camera.isometry().linear().col(1);
  const auto num_pairs = static_cast<double>(pairs.size());
  if (!looks_around(pairs) || camera_up.norm() < kMinCommonUp * num_pairs) return std::nullopt;
  const Eigen::Vector3d up =
      map_from_input.isometry().linear().transpose() * Eigen::Vector3d::UnitZ();
  const double tilt_rad = angle_between(up, camera_up);
  if (tilt_rad <= kMaxTiltRad) return std::nullopt;
  for (const char* axis : {"x", "-x", "y", "-y", "z", "-z"}) {
    const Eigen::Vector3d other =
        map_from_input_axis(axis).value().isometry().linear().transpose() *
        Eigen::Vector3d::UnitZ();
    const double other_rad = angle_between(other, camera_up);
    const bool is_upside_down = other.dot(up) < kOppositeCosine;
    const bool is_turned_about =
        turning_about(other, pairs) > kMinMoreTurning * turning_about(up, pairs);
    if (other_rad > kMinBetterTiltRad || !(is_upside_down || is_turned_about)) continue;
    return finding("the cameras' own up is " + degrees(tilt_rad) +
                       " from that of the map; with --up=" + axis + " (up_axis: \"" + axis +
                       "\") it would be " + degrees(other_rad),
                   "up_axis");
  }
  return std::nullopt;
}

FrameReading reading_of(const DatasetSummary& summary) {
  return {.pose_direction = summary.pose_direction,
          .camera_axes = summary.camera_axes,
          .depth_units_per_m = summary.depth_units_per_m};
}

}  // namespace hypermap
