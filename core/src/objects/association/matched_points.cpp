// SPDX-License-Identifier: BSD-3-Clause
#include "matched_points.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// Farther outside than any image reaches, and still a number of a pixel.
constexpr double kFarPx = 1e9;

}  // namespace

std::optional<std::size_t> only_observation_of(ObjectId id, const AssociationReport& association) {
  const auto& ids = association.object_of_observation;
  if (std::ranges::count(ids, id) != 1) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
}

Eigen::Vector2i pixel_of(const PixelPoint& at) {
  const auto nearest = [](double px) {
    return static_cast<int>(std::clamp(std::floor(px + 0.5), -kFarPx, kFarPx));
  };
  return {nearest(at.u_px), nearest(at.v_px)};
}

std::optional<double> measured_depth_m(const RgbdFrame& frame, const PixelPoint& at) {
  const Eigen::Vector2i pixel = pixel_of(at);
  if (!frame.depth_m.contains(pixel.x(), pixel.y())) return std::nullopt;
  const auto depth_m = static_cast<double>(frame.depth_m.at(pixel.x(), pixel.y()));
  return std::isfinite(depth_m) ? std::optional(depth_m) : std::nullopt;
}

double reach_m(double edge_m, double depth_m) {
  return 1.5 * edge_m + 3.0 * axial_noise_m(depth_m);
}

void follow_points(Object& object, const AssociationOptions& options) {
  const auto box = options.box_from_points ? object.points.agreed_box() : std::nullopt;
  if (!box) return;
  object.box = *box;
  object.centroid_in_map = box->centre();
}

}  // namespace hypermap
