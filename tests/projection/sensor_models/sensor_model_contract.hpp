// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What every inverse sensor model keeps. A case gives a model and its readings:
///
///     struct MyCase {
///       static MyModel model();                       // cells of 0.125 m
///       static MyReading reading(const Eigen::Isometry3d& map_from_world);
///       static MyReading nothing(const Eigen::Isometry3d& map_from_world);
///       /// Whether the cell around a point of the world may be occupied; may be free.
///       static bool may_be_hit(std::size_t layer, const Eigen::Vector2d& in_world);
///       static bool may_be_free(std::size_t layer, const Eigen::Vector2d& in_world);
///     };
///     INSTANTIATE_TYPED_TEST_SUITE_P(Mine, SensorModelContract, MyCase);
#pragma once

#include "../stack/grid_builders.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"
#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace hypermap::test {

inline constexpr double kCellM = 0.125;

template <class Case>
class SensorModelContract : public testing::Test {
 protected:
  static std::vector<SensorGrid> seen_from(const Eigen::Isometry3d& map_from_world) {
    return Case::model().grids(Case::reading(map_from_world)).value();
  }
};

TYPED_TEST_SUITE_P(SensorModelContract);

/// 100 x 100 cells about the map's origin.
inline GridGeometry wide_cells() {
  return {
      .resolution_m = kCellM, .origin = Eigen::Vector2d(-6.25, -6.25), .cols = 100, .rows = 100};
}

inline int wide_at(const LogOddsGrid& grid, Cell cell) {
  const auto there = cell_at(grid.geometry(), centre(wide_cells(), cell));
  return there ? grid.at(*there) : 0;
}

/// The cell that a cell of wide_cells() goes to when those turn a quarter about the map's origin.
inline Cell quarter_turned(Cell cell) {
  return {99 - cell.row, cell.col};
}

TYPED_TEST_P(SensorModelContract, FreeAndOccupiedAreWhereTheyAreInTheWorld) {
  std::size_t num_hit = 0;
  std::size_t num_free = 0;
  const auto grids = this->seen_from(placed(0.0, 0.0));
  ASSERT_FALSE(grids.empty());
  for (std::size_t layer = 0; layer < grids.size(); ++layer) {
    const LogOddsGrid& grid = grids[layer].grid;
    for (int row = 0; row < grid.geometry().rows; ++row) {
      for (int col = 0; col < grid.geometry().cols; ++col) {
        const Eigen::Vector2d middle = centre(grid.geometry(), {col, row});
        const int steps = grid.at({col, row});
        num_hit += steps > 0 ? 1U : 0U;
        num_free += steps < 0 ? 1U : 0U;
        EXPECT_TRUE(steps <= 0 || TypeParam::may_be_hit(layer, middle)) << middle.transpose();
        EXPECT_TRUE(steps >= 0 || TypeParam::may_be_free(layer, middle)) << middle.transpose();
      }
    }
  }
  EXPECT_GE(num_hit, 3U);
  EXPECT_GE(num_free, 5U);
}

TYPED_TEST_P(SensorModelContract, GridsLieOnTheMapsLatticeWithinTheirLimits) {
  for (const SensorGrid& sensor : this->seen_from(placed(0.3, -0.7, 0.4))) {
    const GridGeometry& geometry = sensor.grid.geometry();
    EXPECT_TRUE(validate(geometry).has_value());
    EXPECT_EQ(geometry.yaw_rad, 0.0);
    EXPECT_EQ(geometry.resolution_m, kCellM);
    const Eigen::Vector2d first = geometry.origin / kCellM;
    EXPECT_EQ(first, Eigen::Vector2d(first.array().round()));
    EXPECT_GE(geometry.num_cells(), 1U);
    for (const LogOddsSteps steps : sensor.grid.cells()) {
      EXPECT_LE(std::abs(static_cast<int>(steps)), kMaxLogOddsSteps);
    }
  }
}

TYPED_TEST_P(SensorModelContract, AReadingOfNothingKnowsNothing) {
  const auto full = this->seen_from(placed(0.0, 0.0));
  const auto grids = TypeParam::model().grids(TypeParam::nothing(placed(0.0, 0.0))).value();
  ASSERT_EQ(grids.size(), full.size());
  GridStack stack = GridStack::create(wide_cells()).value();
  for (std::size_t layer = 0; layer < grids.size(); ++layer) {
    EXPECT_EQ(grids[layer].layer, full[layer].layer);
    EXPECT_GE(grids[layer].grid.geometry().num_cells(), 1U);
    EXPECT_EQ(grids[layer].grid.num_known(), 0U);
    EXPECT_EQ(stack.fuse(grids[layer], pose(0.0, 0.0)), 0U);
  }
}

TYPED_TEST_P(SensorModelContract, WholeCellsOfTheWorldMoveTheGridsExactly) {
  const auto here = this->seen_from(placed(0.0, 0.0));
  const auto there = this->seen_from(placed(8 * kCellM, -24 * kCellM));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t layer = 0; layer < here.size(); ++layer) {
    GridGeometry moved = here[layer].grid.geometry();
    moved.origin += Eigen::Vector2d(8 * kCellM, -24 * kCellM);
    EXPECT_EQ(there[layer].grid.geometry(), moved);
    EXPECT_TRUE(std::ranges::equal(there[layer].grid.cells(), here[layer].grid.cells()));
  }
}

TYPED_TEST_P(SensorModelContract, AQuarterTurnOfTheWorldTurnsTheGrids) {
  // Sensors in the middle of a cell would do; at its corner, cells turn into cells as well.
  const auto here = this->seen_from(placed(0.0, 0.0));
  const auto there = this->seen_from(placed(0.0, 0.0, std::numbers::pi / 2.0));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t layer = 0; layer < here.size(); ++layer) {
    int num_other = 0;
    for (int row = 0; row < 100; ++row) {
      for (int col = 0; col < 100; ++col) {
        const int steps = wide_at(here[layer].grid, {col, row});
        const int turned = wide_at(there[layer].grid, quarter_turned({col, row}));
        num_other += std::abs(steps - turned) > 1 ? 1 : 0;
      }
    }
    EXPECT_LE(num_other, TypeParam::kNumCellsOnEdges) << "layer " << layer;
  }
}

TYPED_TEST_P(SensorModelContract, FusedTwiceAGridSaysTwiceAsMuch) {
  for (const SensorGrid& sensor : this->seen_from(placed(0.0, 0.0))) {
    GridStack once = GridStack::create(wide_cells()).value();
    GridStack twice = once;
    const ResamplingOptions nearest{.rule = ResamplingRule::kNearest};
    const std::size_t reached = once.fuse(sensor, pose(0.0, 0.0), nearest).value();
    EXPECT_EQ(reached, sensor.grid.num_known());
    EXPECT_EQ(twice.fuse(sensor, pose(0.0, 0.0), nearest), reached);
    EXPECT_EQ(twice.fuse(sensor, pose(0.0, 0.0), nearest), reached);
    const auto one = once.layers().at(sensor.layer).cells();
    const auto two = twice.layers().at(sensor.layer).cells();
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(two[i], 2 * one[i]);
  }
}

TYPED_TEST_P(SensorModelContract, APoseThatIsNoneIsRefused) {
  Eigen::Isometry3d mirrored = placed(0.0, 0.0);
  mirrored.matrix()(0, 0) = -1.0;
  Eigen::Isometry3d unknown = placed(0.0, 0.0);
  unknown.translation().x() = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Isometry3d& wrong : {mirrored, unknown}) {
    const auto refused = TypeParam::model().grids(TypeParam::reading(wrong));
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_FALSE(refused.error().field.empty());
  }
}

REGISTER_TYPED_TEST_SUITE_P(SensorModelContract,
                            FreeAndOccupiedAreWhereTheyAreInTheWorld,
                            GridsLieOnTheMapsLatticeWithinTheirLimits,
                            AReadingOfNothingKnowsNothing,
                            WholeCellsOfTheWorldMoveTheGridsExactly,
                            AQuarterTurnOfTheWorldTurnsTheGrids,
                            FusedTwiceAGridSaysTwiceAsMuch,
                            APoseThatIsNoneIsRefused);

}  // namespace hypermap::test
