// SPDX-License-Identifier: BSD-3-Clause
#include "depth_registration.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// Whole pixels that a patch covers, both ends included, and how deep it lies.
struct Patch {
  int u_first = 0;
  int v_first = 0;
  int u_last = 0;
  int v_last = 0;
  float depth_m = 0.0F;
};

struct Span1d {
  int first = 0;
  int last = 0;
};

/// Pixels whose centres lie between two edges; the nearest one when there is none.
Span1d covered(double a, double b, int side) {
  const double low = std::min(a, b);
  const double high = std::max(a, b);
  double first = std::ceil(low);
  double last = std::ceil(high) - 1.0;
  if (last < first) first = last = std::floor(0.5 * (low + high) + 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(side))),
          static_cast<int>(std::clamp(last, -1.0, static_cast<double>(side - 1)))};
}

std::optional<Patch> carry_over(int u,
                                int v,
                                double z,
                                const PinholeCamera& depth_camera,
                                const PinholeCamera& color_camera,
                                const Eigen::Isometry3d& color_from_depth) {
  const auto seen = [&](double du, double dv) {
    const PointInCamera in_depth = depth_camera.unproject(u + du, v + dv, z);
    return color_camera.project({color_from_depth * in_depth.xyz});
  };
  const auto low = seen(-0.5, -0.5);
  const auto high = seen(0.5, 0.5);
  if (!low || !high) return std::nullopt;
  const Span1d columns = covered(low->u_px, high->u_px, color_camera.width_px);
  const Span1d rows = covered(low->v_px, high->v_px, color_camera.height_px);
  const Eigen::Vector3d centre = color_from_depth * depth_camera.unproject(u, v, z).xyz;
  return Patch{columns.first, rows.first, columns.last, rows.last, static_cast<float>(centre.z())};
}

}  // namespace

DepthImage register_depth(const DepthImage& depth_m,
                          const PinholeCamera& depth_camera,
                          const PinholeCamera& color_camera,
                          const Eigen::Isometry3d& color_from_depth) {
  DepthImage out(color_camera.width_px, color_camera.height_px, 0.0F);
  for (int v = 0; v < depth_m.height_px(); ++v) {
    for (int u = 0; u < depth_m.width_px(); ++u) {
      const float z = depth_m.at(u, v);
      if (!(z > 0.0F) || !std::isfinite(z)) continue;
      const auto patch =
          carry_over(u, v, static_cast<double>(z), depth_camera, color_camera, color_from_depth);
      if (!patch) continue;
      for (int y = patch->v_first; y <= patch->v_last; ++y) {
        for (int x = patch->u_first; x <= patch->u_last; ++x) {
          float& target = out.at(x, y);
          if (target == 0.0F || patch->depth_m < target) target = patch->depth_m;
        }
      }
    }
  }
  return out;
}

}  // namespace hypermap
