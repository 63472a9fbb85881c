// SPDX-License-Identifier: BSD-3-Clause
#include "depth_registration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace hypermap {
namespace {

struct Span1d {
  int first = 0;
  int last = 0;
};

/// Without a call of the library. Requires: -1 <= x <= 2^20.
int floor_near_zero(double x) {
  return static_cast<int>(x + 1.0) - 1;
}

/// Whole pixels whose centres lie between two edges, both ends included; the nearest one when there
/// is none.
Span1d covered(double a, double b, int side) {
  const auto held = [side](double x) { return std::clamp(x, -0.75, static_cast<double>(side)); };
  const double low = std::min(a, b);
  const double high = std::max(a, b);
  int first = -floor_near_zero(-held(low) + side) + side;
  int last = -floor_near_zero(-held(high) + side) + side - 1;
  if (last < first) first = last = floor_near_zero(held(0.5 * (low + high) + 0.5));
  return {std::max(first, 0), std::min(last, side - 1)};
}

/// Where pixels of one camera lie in the image of another.
class Carrier {
 public:
  Carrier(const PinholeCamera& from, const PinholeCamera& to, const Eigen::Isometry3d& to_from_from)
      : to_(to), origin_(to_from_from.translation()) {
    // The ray of pixel (u, v), per metre of depth, is corner_ + u * right_ + v * down_.
    const Eigen::Matrix3d rotation = to_from_from.linear();
    right_ = rotation.col(0) / from.fx_px;
    down_ = rotation.col(1) / from.fy_px;
    corner_ = rotation.col(2) - from.cx_px * right_ - from.cy_px * down_;
  }

  /// The nearest of patches stays. Requires: z is finite and > 0.
  void carry(int u, int v, double z, std::span<float> out) const {
    const Eigen::Vector3d centre = z * (corner_ + u * right_ + v * down_) + origin_;
    const Eigen::Vector3d half = 0.5 * z * (right_ + down_);
    const Eigen::Vector3d low = centre - half;
    const Eigen::Vector3d high = centre + half;
    if (!(low.z() > 0.0) || !(high.z() > 0.0)) return;
    const Span1d columns = covered(to_.fx_px * low.x() / low.z() + to_.cx_px,
                                   to_.fx_px * high.x() / high.z() + to_.cx_px,
                                   to_.width_px);
    const Span1d rows = covered(to_.fy_px * low.y() / low.z() + to_.cy_px,
                                to_.fy_px * high.y() / high.z() + to_.cy_px,
                                to_.height_px);
    const auto depth_m = static_cast<float>(centre.z());
    for (int y = rows.first; y <= rows.last; ++y) {
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(to_.width_px);
      for (int x = columns.first; x <= columns.last; ++x) {
        float& target = out[row + static_cast<std::size_t>(x)];
        if (target == 0.0F || depth_m < target) target = depth_m;
      }
    }
  }

 private:
  PinholeCamera to_;
  Eigen::Vector3d origin_;
  Eigen::Vector3d right_;
  Eigen::Vector3d down_;
  Eigen::Vector3d corner_;
};

}  // namespace

DepthImage register_depth(const DepthImage& depth_m,
                          const PinholeCamera& depth_camera,
                          const PinholeCamera& color_camera,
                          const Eigen::Isometry3d& color_from_depth) {
  DepthImage out(color_camera.width_px, color_camera.height_px, 0.0F);
  const std::span<float> pixels = out.pixels();
  const Carrier carrier(depth_camera, color_camera, color_from_depth);
  for (int v = 0; v < depth_m.height_px(); ++v) {
    for (int u = 0; u < depth_m.width_px(); ++u) {
      const float z = depth_m.at(u, v);
      if (z > 0.0F && std::isfinite(z)) carrier.carry(u, v, static_cast<double>(z), pixels);
    }
  }
  return out;
}

}  // namespace hypermap
