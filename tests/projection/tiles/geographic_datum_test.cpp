// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/geographic_datum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kEquatorRadius = 6'378'137.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

TEST(GeographicDatum, EastOnTheEquatorIsACircle) {
  // The plane touches a circle of 6378137 m: 1000 m east are atan(1000 / 6378137) of longitude, and
  // sqrt(6378137^2 + 1000^2) - 6378137 = 0.078393 m of altitude.
  const GeographicDatum moved = shifted({}, {1000, 0});
  EXPECT_NEAR(moved.longitude_deg, std::atan(1000 / kEquatorRadius) * kDegrees, 1e-12);
  EXPECT_NEAR(moved.latitude_deg, 0.0, 1e-12);
  EXPECT_NEAR(moved.altitude_m, 0.078393, 1e-6);
  EXPECT_NEAR(moved.yaw_rad, 0.0, 1e-12);
}

TEST(GeographicDatum, NorthFollowsTheMeridiansCurvature) {
  // On the equator the meridian's radius is a (1 - e^2) = 6335439.327 m: 100 m north are
  // 0.000904369 degrees, 1 % more than on a sphere of the equator's radius.
  EXPECT_NEAR(shifted({}, {0, 100}).latitude_deg, 100 / 6'335'439.327 * kDegrees, 1e-12);
  // At 52 degrees, sin^2 = 0.62096: N = a / sqrt(1 - e^2 sin^2) = 6391430.7 m, M = a (1 - e^2) /
  // (1 - e^2 sin^2)^1.5 = 6375126.6 m. Ten metres, so that curvature does not count.
  const GeographicDatum bielefeld{.latitude_deg = 52, .longitude_deg = 8.5, .altitude_m = 0};
  const double e2 = 6.694379990141e-3;
  const double s2 = std::pow(std::sin(52 / kDegrees), 2);
  const double n = kEquatorRadius / std::sqrt(1 - e2 * s2);
  const double m = kEquatorRadius * (1 - e2) / std::pow(1 - e2 * s2, 1.5);
  const GeographicDatum moved = shifted(bielefeld, {10, 10});
  EXPECT_NEAR(moved.latitude_deg, 52 + 10 / m * kDegrees, 1e-9);
  EXPECT_NEAR(moved.longitude_deg, 8.5 + 10 / (n * std::cos(52 / kDegrees)) * kDegrees, 1e-9);
}

TEST(GeographicDatum, TheWayThereAndBackIsOne) {
  for (const double latitude : {-89.0, -33.0, 0.0, 52.0}) {
    const GeographicDatum datum{
        .latitude_deg = latitude, .longitude_deg = 179.9999, .altitude_m = 130, .yaw_rad = 0.7};
    const GeographicDatum there = shifted(datum, {30, -20});
    // Over 36 m the two planes differ by 0.1 mm of altitude and nothing else.
    const GeographicDatum back = shifted(there, {-30, 20});
    EXPECT_NEAR(back.latitude_deg, datum.latitude_deg, 1e-8);
    EXPECT_NEAR(std::remainder(back.longitude_deg - datum.longitude_deg, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(back.altitude_m, datum.altitude_m, 1e-3);
    EXPECT_NEAR(back.yaw_rad, datum.yaw_rad, 1e-6);
  }
}

TEST(GeographicDatum, YawIsTheTurnOfTheXAxisFromEast) {
  // x points north: 100 m along x are north; along y west.
  const GeographicDatum datum{.latitude_deg = 10, .yaw_rad = std::numbers::pi / 2};
  EXPECT_GT(shifted(datum, {100, 0}).latitude_deg, 10.0009);
  EXPECT_LT(shifted(datum, {0, 100}).longitude_deg, -0.0009);
  // Meridians converge: 1 km east at 60 degrees, east has turned by 1000 tan(60) / N = 2.7e-4 rad
  // to the left, so that the old east lies to the right of it.
  const GeographicDatum moved = shifted({.latitude_deg = 60}, {1000, 0});
  EXPECT_NEAR(moved.yaw_rad, -1000 * std::tan(60 / kDegrees) / 6'394'209.0, 1e-7);
}

TEST(GeographicDatum, NoShiftChangesNothing) {
  const GeographicDatum datum{
      .latitude_deg = 90, .longitude_deg = -180, .altitude_m = -3, .yaw_rad = 9};
  EXPECT_EQ(shifted(datum, {0, 0}), datum);
}

TEST(GeographicDatum, WhatIsNoPlaceIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field_of = [](const GeographicDatum& datum) {
    const auto checked = validate(datum);
    return checked ? std::string() : checked.error().field;
  };
  EXPECT_EQ(field_of({.latitude_deg = -90, .longitude_deg = 180, .altitude_m = 1e5}), "");
  EXPECT_EQ(field_of({.latitude_deg = 90.01}), "latitude_deg");
  EXPECT_EQ(field_of({.latitude_deg = nan}), "latitude_deg");
  EXPECT_EQ(field_of({.longitude_deg = -180.01}), "longitude_deg");
  EXPECT_EQ(field_of({.altitude_m = 1e6}), "altitude_m");
  EXPECT_EQ(field_of({.yaw_rad = nan}), "yaw_rad");
}

}  // namespace
}  // namespace hypermap
