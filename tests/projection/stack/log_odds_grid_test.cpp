// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include "grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

using test::sized;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(LogOddsSteps, AreThousandthsAndNeverMoreThanTheBound) {
  EXPECT_EQ(to_steps(LogOdds(0.0)), 0);
  EXPECT_EQ(to_steps(LogOdds(1.2344)), 1234);
  EXPECT_EQ(to_steps(LogOdds(0.0005)), 1);  // half a step goes away from 0, either way
  EXPECT_EQ(to_steps(LogOdds(-0.0005)), -1);
  EXPECT_EQ(to_steps(LogOdds::of(Probability(1.0))), 13'815);
  EXPECT_EQ(to_steps(LogOdds::of(Probability(0.0))), -13'815);
  EXPECT_DOUBLE_EQ(from_steps(-13'815).value(), -13.815);
}

TEST(LogOddsGrid, ProbabilitiesBecomeLogOdds) {
  // ln(0.8 / 0.2) = 1.386 294.
  const std::array p{0.5, 0.8, 0.2, 0.0, 1.0, 0.5};
  const auto grid = LogOddsGrid::of_probabilities(sized(3, 2), p);
  ASSERT_TRUE(grid);
  EXPECT_THAT(grid->cells(), ElementsAre(0, 1386, -1386, -13'815, 13'815, 0));
  EXPECT_EQ(grid->num_known(), 4U);
  EXPECT_EQ(grid->at({1, 0}), 1386);
}

TEST(LogOddsGrid, PerCentsComeBackAsTheyWere) {
  std::vector<std::int8_t> cells;
  for (int i = -1; i <= 100; ++i) cells.push_back(static_cast<std::int8_t>(i));
  const auto occupancy = OccupancyGrid::create(sized(51, 2), cells).value();
  const auto back = to_occupancy(LogOddsGrid::of_occupancy(occupancy).value()).value();
  EXPECT_EQ(back.geometry(), occupancy.geometry());
  cells[51] = kUnknownCell;  // 50 per cent is no knowledge
  EXPECT_THAT(back.cells(), testing::ElementsAreArray(cells));
}

TEST(LogOddsGrid, WhatIsNoProbabilityIsRefusedByItsCell) {
  for (const double wrong : {std::nan(""), -0.1, 1.1, std::numeric_limits<double>::infinity()}) {
    const auto grid = LogOddsGrid::of_probabilities(sized(2, 1), std::array{0.5, wrong});
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(grid.error().what, HasSubstr("in cell 1"));
  }
}

TEST(LogOddsGrid, WrongSizesAndBoundsAreRefused) {
  EXPECT_THAT(LogOddsGrid::create(sized(2, 2), {1, 2, 3}).error().what, HasSubstr("3 cells given"));
  EXPECT_THAT(LogOddsGrid::create(sized(1, 1), {13'816}).error().what, HasSubstr("is 13.816"));
  EXPECT_FALSE(LogOddsGrid::of_probabilities(sized(2, 2), std::array{0.5}));
  EXPECT_EQ(LogOddsGrid::create(sized(70'000, 1)).error().code, ErrorCode::kLimit);
  EXPECT_FALSE(LogOddsGrid::create(sized(1, 1, std::nan(""))));
  EXPECT_TRUE(LogOddsGrid::create(GridGeometry{}));
}

}  // namespace
}  // namespace hypermap
