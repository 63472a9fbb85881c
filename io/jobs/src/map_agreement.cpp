// SPDX-License-Identifier: BSD-3-Clause
#include "map_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr int kPixelStep = 10;
constexpr double kMinDepthM = 0.3;
constexpr double kMaxDepthM = 5.0;
constexpr std::size_t kMinPoints = 200;
constexpr double kMinKnownShare = 0.02;
constexpr double kMinOccupiedShare = 0.6;
constexpr double kMaxUprightNormalZ = 0.7;

enum class Space { kUnknown, kFree, kOccupied };

/// Occupied when the voxel or one of those around it is.
Space space_around(const SemanticOctree& map, const PointInMap& point) {
  const auto middle = map.at(point);
  if (middle && middle->occupied) return Space::kOccupied;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto near = map.at(PointInMap{point.xyz + map.resolution_m() * step.cast<double>()});
    if (near && near->occupied) return Space::kOccupied;
  }
  return middle ? Space::kFree : Space::kUnknown;
}

std::optional<PointInMap> point_at(const RgbdFrame& frame, int u, int v) {
  if (!frame.depth_m.contains(u, v)) return std::nullopt;
  const auto depth_m = static_cast<double>(frame.depth_m.at(u, v));
  if (!(depth_m >= kMinDepthM && depth_m <= kMaxDepthM)) return std::nullopt;
  return frame.map_from_camera * frame.camera.unproject(u, v, depth_m);
}

/// A point of a surface that is not level: floors lie at one height in all places.
std::optional<PointInMap> upright_point(const RgbdFrame& frame, int u, int v) {
  auto point = point_at(frame, u, v);
  const auto right = point_at(frame, u + kPixelStep, v);
  const auto below = point_at(frame, u, v + kPixelStep);
  if (!point || !right || !below) return std::nullopt;
  const Eigen::Vector3d normal =
      (right->xyz - point->xyz).cross(below->xyz - point->xyz).normalized();
  if (!(std::abs(normal.z()) <= kMaxUprightNormalZ)) return std::nullopt;
  return point;
}

std::string percent(std::size_t part, std::size_t whole) {
  return std::to_string(100 * part / whole) + " %";
}

Finding finding(std::string what) {
  return {
      .error = {.code = ErrorCode::kInvalidArgument, .what = std::move(what), .field = "--append"}};
}

}  // namespace

std::vector<RgbdFrame> spread_frames(const DatasetReader& dataset, std::size_t count) {
  std::vector<RgbdFrame> frames;
  const std::size_t wanted = std::min(count, dataset.size());
  frames.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {
    auto frame = dataset.read(i * dataset.size() / wanted);
    if (frame) frames.push_back(std::move(*frame));
  }
  return frames;
}

MapAgreement agreement(const RgbdFrame& frame, const SemanticOctree& map) {
  MapAgreement sum;
  for (int v = 0; v < frame.depth_m.height_px(); v += kPixelStep) {
    for (int u = 0; u < frame.depth_m.width_px(); u += kPixelStep) {
      const auto point = upright_point(frame, u, v);
      if (!point) continue;
      const Space space = space_around(map, *point);
      ++sum.num_points;
      sum.num_known += space != Space::kUnknown ? 1U : 0U;
      sum.num_occupied += space == Space::kOccupied ? 1U : 0U;
    }
  }
  return sum;
}

std::optional<Finding> compare(std::span<const RgbdFrame> frames, const SemanticOctree& map) {
  MapAgreement sum;
  for (const RgbdFrame& frame : frames) {
    const MapAgreement one = agreement(frame, map);
    sum.num_points += one.num_points;
    sum.num_known += one.num_known;
    sum.num_occupied += one.num_occupied;
  }
  if (sum.num_points < kMinPoints) return std::nullopt;
  if (static_cast<double>(sum.num_known) < kMinKnownShare * static_cast<double>(sum.num_points)) {
    return finding(
        "shows nothing of what the map knows: " + percent(sum.num_known, sum.num_points) +
        " of the points of " + std::to_string(frames.size()) + " frames");
  }
  if (static_cast<double>(sum.num_occupied) <
      kMinOccupiedShare * static_cast<double>(sum.num_known)) {
    return finding("shows another place than the map, or lies elsewhere in it: of the points of " +
                   std::to_string(frames.size()) + " frames that fall where the map knows space, " +
                   percent(sum.num_occupied, sum.num_known) + " meet occupied space");
  }
  return std::nullopt;
}

}  // namespace hypermap
