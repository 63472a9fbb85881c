// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where on Earth a frame of the plane lies.
///
/// Source: [sogm] III-E (the NavSat datum of a tile); NIMA TR8350.2, third edition, 3.2 and
/// 4.2 (ellipsoid of WGS 84).
#pragma once

#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

namespace hypermap {

/// The origin of a frame on the ellipsoid of WGS 84, and how its x axis points.
struct GeographicDatum {
  double latitude_deg = 0.0;   ///< -90 to 90, north is positive.
  double longitude_deg = 0.0;  ///< -180 to 180, east is positive.
  double altitude_m = 0.0;     ///< Above the ellipsoid.
  double yaw_rad = 0.0;        ///< Of the x axis, counter-clockwise from east.
  friend bool operator==(const GeographicDatum&, const GeographicDatum&) = default;
};

/// Errors: kInvalidArgument naming the field: beyond its range, not finite, or an altitude beyond
/// 1e5 m.
[[nodiscard]] Result<void> validate(const GeographicDatum& datum);

/// That of the frame which is `datum`'s frame shifted to `point` (x, y; z = 0).
///
/// The plane touches the ellipsoid's normal at the datum and stays flat: 1 km away it lies 8 cm
/// higher above the ellipsoid. Yaw is that to the east of the new place. Within a micrometre up
/// to 1000 km from the datum. Requires: the datum is valid, the point finite. Boundary: at a pole
/// east is where the datum's longitude says.
[[nodiscard]] GeographicDatum shifted(const GeographicDatum& datum, const Eigen::Vector2d& point);

}  // namespace hypermap
