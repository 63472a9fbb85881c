// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/geographic_datum.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <string>

namespace hypermap {
namespace {

constexpr double kEquatorRadius = 6'378'137.0;  // in metres
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kHighest = 1e5;  // in metres
constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Radius of curvature in the prime vertical.
double prime_vertical(double sin_latitude) {
  return kEquatorRadius / std::sqrt(1.0 - kEccentricity2 * sin_latitude * sin_latitude);
}

/// East, north and up as columns, in coordinates of Earth's centre.
Eigen::Matrix3d earth_from_local(double latitude_rad, double longitude_rad) {
  const double sin_lat = std::sin(latitude_rad);
  const double cos_lat = std::cos(latitude_rad);
  const double sin_lon = std::sin(longitude_rad);
  const double cos_lon = std::cos(longitude_rad);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(-sin_lon, cos_lon, 0.0);
  axes.col(1) = Eigen::Vector3d(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
  axes.col(2) = Eigen::Vector3d(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
  return axes;
}

Eigen::Vector3d earth_centred(double latitude_rad, double longitude_rad, double altitude_m) {
  const double sin_lat = std::sin(latitude_rad);
  const double cos_lat = std::cos(latitude_rad);
  const double radius = prime_vertical(sin_lat);
  return {(radius + altitude_m) * cos_lat * std::cos(longitude_rad),
          (radius + altitude_m) * cos_lat * std::sin(longitude_rad),
          ((1.0 - kEccentricity2) * radius + altitude_m) * sin_lat};
}

/// Each round brings the error down by the eccentricity's square, 0.0067.
double latitude_of(double from_axis, double z) {
  constexpr int kRounds = 8;
  double latitude = std::atan2(z, from_axis * (1.0 - kEccentricity2));
  for (int i = 0; i < kRounds; ++i) {
    const double sin_lat = std::sin(latitude);
    latitude = std::atan2(z + kEccentricity2 * prime_vertical(sin_lat) * sin_lat, from_axis);
  }
  return latitude;
}

Result<void> check_range(double value, double bound, const char* field) {
  if (std::abs(value) <= bound) return {};  // false for NaN
  return fail(ErrorCode::kInvalidArgument,
              "must be from -" + number_text(bound) + " to " + number_text(bound) + ", is " +
                  number_text(value),
              field);
}

}  // namespace

Result<void> validate(const GeographicDatum& datum) {
  HYPERMAP_TRY(check_range(datum.latitude_deg, 90.0, "latitude_deg"));
  HYPERMAP_TRY(check_range(datum.longitude_deg, 180.0, "longitude_deg"));
  HYPERMAP_TRY(check_range(datum.altitude_m, kHighest, "altitude_m"));
  if (std::isfinite(datum.yaw_rad)) return {};
  return fail(ErrorCode::kInvalidArgument, "must be finite", "yaw_rad");
}

GeographicDatum shifted(const GeographicDatum& datum, const Eigen::Vector2d& point) {
  if (point.isZero(0.0)) return datum;
  const double latitude = datum.latitude_deg * kRadPerDeg;
  const double longitude = datum.longitude_deg * kRadPerDeg;
  const Eigen::Matrix3d axes = earth_from_local(latitude, longitude);
  const Eigen::Vector2d x_axis(std::cos(datum.yaw_rad), std::sin(datum.yaw_rad));
  const Eigen::Vector3d offset(x_axis.x() * point.x() - x_axis.y() * point.y(),
                               x_axis.y() * point.x() + x_axis.x() * point.y(),
                               0.0);
  const Eigen::Vector3d place =
      earth_centred(latitude, longitude, datum.altitude_m) + axes * offset;
  const double from_axis = std::hypot(place.x(), place.y());
  const double there = latitude_of(from_axis, place.z());
  const double meridian = from_axis == 0.0 ? longitude : std::atan2(place.y(), place.x());
  const double sin_lat = std::sin(there);
  const Eigen::Vector3d x_in_earth = axes.leftCols<2>() * x_axis;
  const Eigen::Vector3d x_there = earth_from_local(there, meridian).transpose() * x_in_earth;
  return {.latitude_deg = there / kRadPerDeg,
          .longitude_deg = meridian / kRadPerDeg,
          .altitude_m = from_axis * std::cos(there) + place.z() * sin_lat -
                        kEquatorRadius * std::sqrt(1.0 - kEccentricity2 * sin_lat * sin_lat),
          .yaw_rad = std::atan2(x_there.y(), x_there.x())};
}

}  // namespace hypermap
