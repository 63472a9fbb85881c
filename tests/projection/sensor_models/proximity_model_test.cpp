// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/proximity_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap::test {
namespace {

int steps_of(const ProximityModel& model, double range_m, const Eigen::Vector2d& point) {
  const ProximityReading reading{MapFromScanner(mounted(0.3)), range_m};
  const LogOddsGrid grid = model.grids(reading).value().front().grid;
  const auto cell = cell_at(grid.geometry(), point);
  return cell ? grid.at(*cell) : 0;
}

Eigen::Vector2d polar(double radius_m, double bearing_rad) {
  return radius_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
}

TEST(ProximityModel, TheConeIsFreeAndItsArcOccupied) {
  const ProximityModel model = ProximityModel::create({.field_of_view_rad = 0.8}).value();
  for (const double bearing : {-0.35, -0.1, 0.0, 0.2, 0.35}) {
    EXPECT_EQ(steps_of(model, 2.0, polar(1.0, bearing)), kFree) << bearing;
    EXPECT_GT(steps_of(model, 2.0, polar(2.0, bearing)), 0) << bearing;
    EXPECT_EQ(steps_of(model, 2.0, polar(2.3, bearing)), 0) << bearing;
  }
  EXPECT_EQ(steps_of(model, 2.0, polar(1.5, 0.5)), 0);
}

TEST(ProximityModel, ACellOfTheArcSaysItsPartOfTheEnd) {
  // An end of 1 m +- 0.25 in cells of 0.5 m, 1 rad wide: [1, 1.5) x [0, 0.5) is covered by what
  // lies between 1 and 1.25 m. With 0.5 m the end is as long as the cell: evidence by area alone.
  // Area right of x = 1 in the circle of 1.25 m, above y = 0, below the ray of 0.5 rad (it leaves
  // x = 1 at y = 0.546, above the cell): integral of sqrt(1.5625 - y^2) - 1 for y in [0, 0.5].
  const ProximityModel model =
      ProximityModel::create({.evidence = {.resolution_m = 0.5, .p_hit = Probability(0.6)},
                              .field_of_view_rad = 1.0,
                              .range_error_m = 0.25,
                              .range_error_per_m = 0.0})
          .value();
  const double under_arc =
      0.5 * (0.5 * std::sqrt(1.5625 - 0.25) + 1.5625 * std::asin(0.5 / 1.25)) - 0.5;
  const double share = under_arc / 0.25;
  EXPECT_NEAR(steps_of(model, 1.0, {1.1, 0.2}), share * 405.0, 1.0);
}

TEST(ProximityModel, FieldsOfViewAreTheSensorsOwn) {
  const ProximityModel narrow = ProximityModel::create({.field_of_view_rad = 0.1}).value();
  const ProximityModel wide = ProximityModel::create({.field_of_view_rad = 1.0}).value();
  EXPECT_EQ(steps_of(narrow, 2.0, polar(1.0, 0.3)), 0);
  EXPECT_EQ(steps_of(wide, 2.0, polar(1.0, 0.3)), kFree);
}

TEST(ProximityModel, WithoutAnEchoTheConeIsFreeUnlessAskedOtherwise) {
  const ProximityModel usual = ProximityModel::create({.max_range_m = 2.0}).value();
  EXPECT_EQ(steps_of(usual, kNoReading, {1.5, 0.0}), kFree);
  EXPECT_EQ(steps_of(usual, kNoReading, {2.01, 0.0}), 0);
  const ProximityModel careful =
      ProximityModel::create({.max_range_m = 2.0, .no_return = NoReturnRule::kIgnored}).value();
  EXPECT_EQ(steps_of(careful, kNoReading, {1.5, 0.0}), 0);
}

TEST(ProximityModel, ATiltedSensorIsRefused) {
  const ProximityReading down{MapFromScanner(mounted(0.3, 0.5)), 1.0};
  EXPECT_EQ(ProximityModel::create().value().grids(down).error().field, "map_from_scanner");
  EXPECT_EQ(validate(ProximityOptions{.field_of_view_rad = 0.0}).error().field,
            "field_of_view_rad");
}

}  // namespace
}  // namespace hypermap::test
