// SPDX-License-Identifier: BSD-3-Clause
#include "matched_points.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {

std::optional<std::size_t> only_observation_of(ObjectId id, const AssociationReport& association) {
  const auto& ids = association.object_of_observation;
  if (std::ranges::count(ids, id) != 1) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
}

std::optional<double> measured_depth_m(const RgbdFrame& frame, const PixelPoint& at) {
  const double u_px = std::floor(at.u_px + 0.5);
  const double v_px = std::floor(at.v_px + 0.5);
  const bool is_inside = u_px >= 0.0 && v_px >= 0.0 && u_px < frame.depth_m.width_px() &&
                         v_px < frame.depth_m.height_px();
  if (!is_inside) return std::nullopt;
  const auto depth_m =
      static_cast<double>(frame.depth_m.at(static_cast<int>(u_px), static_cast<int>(v_px)));
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
