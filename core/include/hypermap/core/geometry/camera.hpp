// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a point of space falls in the image, and what ray a pixel looks along.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <optional>

namespace hypermap {

/// Where a point falls in the image. The centre of the upper left pixel is (0, 0).
struct PixelPoint {
  double u_px = 0.0;
  double v_px = 0.0;
};

/// Pinhole camera without distortion; depth is registered to colour.
///
/// Frame: optical, +z forward, +x right, +y down. Source: [smap] 3.1, u = f x / z.
struct PinholeCamera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;

  /// The point seen at pixel (u, v) at `depth_m` along the optical axis.
  [[nodiscard]] PointInCamera unproject(double u_px, double v_px, double depth_m) const {
    return {{(u_px - cx_px) / fx_px * depth_m, (v_px - cy_px) / fy_px * depth_m, depth_m}};
  }
  /// Where `point` is seen; none when it is not in front of the camera (z <= 0). The result may lie
  /// outside the image.
  [[nodiscard]] std::optional<PixelPoint> project(const PointInCamera& point) const {
    if (!(point.xyz.z() > 0.0)) return std::nullopt;
    return PixelPoint{fx_px * point.xyz.x() / point.xyz.z() + cx_px,
                      fy_px * point.xyz.y() / point.xyz.z() + cy_px};
  }
};

/// Errors: kInvalidArgument naming the field: sides in 1..65535, focal lengths finite and > 0,
/// centre finite and inside the image (a margin of half its side is allowed).
[[nodiscard]] Result<void> validate(const PinholeCamera& camera);

}  // namespace hypermap
