// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/resampling.hpp"

#include "grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::grid_of;
using test::pose;
using test::random_grid;
using test::sized;
using test::sum_of;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kAllRules{
    ResamplingRule::kNearest, ResamplingRule::kBilinear, ResamplingRule::kBiodds};

TEST(Resampling, OntoItsOwnCellsNothingChanges) {
  const LogOddsGrid grid = random_grid(sized(17, 9), 1, 13'815);
  for (const ResamplingRule rule : kAllRules) {
    EXPECT_EQ(resampled(grid, grid.geometry(), Eigen::Matrix3d::Identity(), {.rule = rule}).value(),
              grid);
  }
}

TEST(Resampling, WholeCellsThereAndBackChangeNothing) {
  // Room for the shift on every side, cells that are not square in number, 0.05 m is no sum of
  // powers of two.
  const GridGeometry geometry = sized(31, 22, 0.05);
  LogOddsGrid grid = random_grid(geometry, 2, 13'815);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const bool is_inner = col >= 6 && row >= 6 && col < 25 && row < 16;
      if (!is_inner) grid.set({col, row}, 0);
    }
  }
  for (const ResamplingRule rule : kAllRules) {
    const auto there = resampled(grid, geometry, pose(0.25, -0.3), {.rule = rule}).value();
    EXPECT_EQ(there.at({11, 2}), grid.at({6, 8}));
    EXPECT_NE(there, grid);
    EXPECT_EQ(resampled(there, geometry, pose(-0.25, 0.3), {.rule = rule}).value(), grid);
  }
}

TEST(Resampling, AQuarterTurnMovesCellsWhole) {
  // Cells (col, row) of a 3 x 2 grid, turned by 90 degrees: x' = -y, y' = x. The target's origin
  // lies at (-0.2, 0), 2 x 3 cells; cell (0, 0) of it, centre (-0.15, 0.05), was at (0.05, 0.15).
  const LogOddsGrid grid = grid_of(sized(3, 2), {1, 2, 3, 4, 5, 6});
  GridGeometry target = sized(2, 3);
  target.origin = {-0.2, 0.0};
  for (const ResamplingRule rule : kAllRules) {
    const auto turned =
        resampled(grid, target, pose(0, 0, std::numbers::pi / 2), {.rule = rule}).value();
    EXPECT_THAT(turned.cells(), ElementsAre(4, 1, 5, 2, 6, 3));
  }
}

TEST(Resampling, HalfACellFurtherEvidenceIsSharedOut) {
  const LogOddsGrid grid = grid_of(sized(3, 1), {0, 2000, 0});
  GridGeometry target = sized(4, 1);
  target.origin = {-0.05, 0.0};
  EXPECT_THAT(resampled(grid, target, pose(0, 0)).value().cells(), ElementsAre(0, 1000, 1000, 0));
}

TEST(Resampling, AMoreDetailedGridIsMadeByTheRule) {
  // The fine cells' centres lie a quarter of a cell from the coarse ones': three quarters of 4000
  // at the ends, beyond which nothing is known; 0.75 * 4000 - 0.25 * 4000 = 2000 inside.
  const LogOddsGrid grid = grid_of(sized(2, 1, 0.2), {4000, -4000});
  const auto fine = [&](ResamplingRule rule) {
    return resampled(grid, sized(4, 1, 0.1), pose(0, -0.05), {.rule = rule}).value();
  };
  EXPECT_THAT(fine(ResamplingRule::kNearest).cells(), ElementsAre(4000, 4000, -4000, -4000));
  EXPECT_THAT(fine(ResamplingRule::kBiodds).cells(), ElementsAre(3000, 2000, -2000, -3000));
}

TEST(Resampling, EvidenceReachesHalfACellBeyondTheEdge) {
  // One cell of 0.4 m, centre 0.2, on cells of 0.1 m: those from 0.0 to 0.4 lie within it, centres
  // 0.05 and 0.15 to either side of the middle; the ones beyond, at 0.25 and 0.35, have 1 - 0.35 /
  // 0.4 and 1 - 0.25 / 0.4 of it.
  const LogOddsGrid one = grid_of(sized(1, 1, 0.4), {8000});
  GridGeometry row = sized(10, 1, 0.1);
  row.origin = {-0.3, 0.15};
  EXPECT_THAT(resampled(one, row, pose(0, 0)).value().cells(),
              ElementsAre(0, 1000, 3000, 5000, 7000, 7000, 5000, 3000, 1000, 0));
}

TEST(Resampling, ShrinkingMakesAndLosesNoEvidence) {
  // Each coarse cell is 2 x 2 fine ones: the sum of log-odds times area stays. Multiples of 4 steps
  // divide without a rest.
  GridGeometry fine = sized(4, 6, 0.1);
  LogOddsGrid grid = random_grid(fine, 9, 2000);
  for (int row = 0; row < fine.rows; ++row) {
    for (int col = 0; col < fine.cols; ++col) {
      const int whole = grid.at({col, row}) / 4 * 4;
      grid.set({col, row}, static_cast<LogOddsSteps>(whole));
    }
  }
  for (const ResamplingRule rule : {ResamplingRule::kBilinear, ResamplingRule::kBiodds}) {
    const auto coarse = resampled(grid, sized(2, 3, 0.2), pose(0, 0), {.rule = rule}).value();
    EXPECT_EQ(4 * sum_of(coarse), sum_of(grid));
    const long corner = grid.at({0, 0}) + grid.at({1, 0}) + grid.at({0, 1}) + grid.at({1, 1});
    EXPECT_EQ(coarse.at({0, 0}), corner / 4);
  }
}

TEST(Resampling, ShrinkingAtAnyScaleAndTurnKeepsTheSumUpToRounding) {
  // Log-odds times area in units of a fine cell; each coarse cell is rounded by half a step.
  const LogOddsGrid grid = random_grid(sized(40, 25, 0.05), 4, 13'000);
  for (const double resolution : {0.051, 0.07, 0.13, 0.33}) {
    for (const double yaw : {0.0, 0.4, 2.0}) {
      GridGeometry coarse = sized(180, 180, resolution);
      coarse.origin = Eigen::Vector2d(-90, -90) * resolution;
      const auto shrunk = resampled(grid, coarse, pose(0.3, -0.2, yaw)).value();
      const double area = resolution * resolution / (0.05 * 0.05);
      const double allowed = 0.5 * area * static_cast<double>(shrunk.num_known()) + 1e-3;
      EXPECT_NEAR(
          area * static_cast<double>(sum_of(shrunk)), static_cast<double>(sum_of(grid)), allowed)
          << resolution << " " << yaw;
      // The bound is far below what was summed, or nothing was shown.
      EXPECT_LT(allowed, 0.05 * 13'000 * 800);
    }
  }
}

TEST(Resampling, NearestTakesTheMiddleAtAnyScale) {
  const LogOddsGrid grid = grid_of(sized(3, 3), {1, 2, 3, 4, 5, 6, 7, 8, 9});
  const auto one = resampled(grid, sized(1, 1, 0.3), pose(0, 0), {ResamplingRule::kNearest, {}});
  EXPECT_FALSE(one);  // an epsilon of 0.5 leaves nothing
  EXPECT_THAT(resampled(grid, sized(1, 1, 0.3), pose(0, 0), {.rule = ResamplingRule::kNearest})
                  .value()
                  .cells(),
              ElementsAre(5));
}

TEST(Resampling, AHomographyIsFollowedToItsHorizon) {
  // x' = x / (1 + x), y' = y / (1 + x): the source's cells crowd towards x' = 1, its points with
  // x < -1 lie beyond the horizon. The centre (0.35, 0.05) of target cell (3, 0) was at x = x' / (1
  // - x') = 0.538 46, y = y' / (1 - x') = 0.076 92: source cell (5, 0) of 0.1 m.
  Eigen::Matrix3d perspective = Eigen::Matrix3d::Identity();
  perspective(2, 0) = 1.0;
  LogOddsGrid grid = LogOddsGrid::create(sized(60, 10)).value();
  grid.set({5, 0}, 700);
  const ResamplingOptions nearest{.rule = ResamplingRule::kNearest};
  const auto seen = resampled(grid, sized(20, 10), perspective, nearest).value();
  EXPECT_EQ(seen.at({3, 0}), 700);
  EXPECT_EQ(seen.num_known(), 1U);
  // A source from x = -2 to x = 6 reaches over its horizon at x = -1. Nothing is seen at x' >= 1:
  // what would be there lies behind.
  GridGeometry across = sized(80, 10);
  across.origin = {-2.0, 0.0};
  const LogOddsGrid full = grid_of(across, std::vector<LogOddsSteps>(800, LogOddsSteps{300}));
  for (const ResamplingRule rule : kAllRules) {
    const auto all = resampled(full, sized(40, 3), perspective, {.rule = rule}).value();
    for (int row = 0; row < 3; ++row) {
      for (int col = 10; col < 40; ++col) EXPECT_EQ(all.at({col, row}), 0);
    }
    EXPECT_EQ(all.at({4, 1}), 300);
  }
  // The factor of a homography, its sign too, is of no matter.
  EXPECT_EQ(resampled(grid, sized(20, 10), -3.0 * perspective, nearest).value(), seen);
}

TEST(Resampling, AMirrorIsAHomographyToo) {
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(0, 0) = -1.0;
  mirror(0, 2) = 0.4;
  const LogOddsGrid grid = grid_of(sized(4, 1), {1000, 2000, 3000, 4000});
  EXPECT_THAT(resampled(grid, sized(4, 1), mirror).value().cells(),
              ElementsAre(4000, 3000, 2000, 1000));
  // One cell of 0.4 m: a quarter of it is covered, by all four.
  EXPECT_THAT(resampled(grid, sized(1, 1, 0.4), mirror).value().cells(), ElementsAre(625));
}

TEST(Resampling, OneCellIsAGridToo) {
  const LogOddsGrid one = grid_of(sized(1, 1), {5000});
  EXPECT_THAT(resampled(one, sized(1, 1), pose(0, 0)).value().cells(), ElementsAre(5000));
  EXPECT_THAT(resampled(one, sized(1, 1, 0.2), pose(0, 0)).value().cells(), ElementsAre(1250));
  EXPECT_THAT(resampled(one, sized(1, 1), pose(0.02, 0)).value().cells(), ElementsAre(4000));
}

TEST(Resampling, WhatCannotBeDoneIsSaid) {
  const LogOddsGrid grid = grid_of(sized(2, 1), {1, 2});
  const auto what = [&](const GridGeometry& target, const Eigen::Matrix3d& homography) {
    const auto failed = resampled(grid, target, homography);
    EXPECT_FALSE(failed);
    return failed ? std::string() : to_string(failed.error());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3d at_horizon = pose(0, 0);
  at_horizon.row(2) = Eigen::RowVector3d(1, 0, -0.1);
  EXPECT_THAT(what(sized(2, 1), nan * pose(0, 0)), HasSubstr("homography: must be finite"));
  EXPECT_THAT(what(sized(2, 1), Eigen::Matrix3d::Zero()), HasSubstr("at its horizon"));
  EXPECT_THAT(what(sized(2, 1), at_horizon), HasSubstr("at its horizon"));
  EXPECT_THAT(what(sized(2, 1), Eigen::Vector3d(1, 0, 1).asDiagonal()), HasSubstr("no inverse"));
  EXPECT_THAT(what(sized(2, 1), pose(5, 0)), HasSubstr("lies outside: its middle is at column 51"));
  EXPECT_THAT(what(GridGeometry{}, pose(0, 0)), HasSubstr("target: has no cells"));
  EXPECT_THAT(what(sized(70'000, 1), pose(0, 0)), HasSubstr("65535 a side"));
  EXPECT_FALSE(resampled(LogOddsGrid(), sized(1, 1), pose(0, 0)));
  for (const double epsilon : {0.0, 1e-7, 0.5, 1.0}) {
    const auto failed = resampled(grid, sized(1, 1), pose(0, 0), {.epsilon = Probability(epsilon)});
    ASSERT_FALSE(failed) << epsilon;
    EXPECT_EQ(failed.error().field, "epsilon");
  }
}

TEST(Resampling, ACellTakesTheSameWhicheverGridItIsPartOf) {
  // Grids of one lattice, here and there in one large grid, at poses that are no whole cells: to
  // the bit, whatever the origins do to rounding.
  const GridGeometry large{
      .resolution_m = 0.01, .origin = {-35.07, 19.93}, .cols = 500, .rows = 400};
  for (const auto rule :
       {ResamplingRule::kNearest, ResamplingRule::kBilinear, ResamplingRule::kBiodds}) {
    for (unsigned i = 0; i < 20; ++i) {
      const double resolution_m = i % 4 == 0 ? 0.004 : 0.01 + 0.001 * i;
      const LogOddsGrid source = random_grid(sized(30, 20, resolution_m), i, 9000);
      const Eigen::Matrix3d at = pose(-34.9 + 0.213 * i, 20.11 + 0.153 * i, 0.37 * i);
      const LogOddsGrid whole = resampled(source, large, at, {.rule = rule}).value();
      ASSERT_GT(whole.num_known(), 20U);
      const Cell first{15 * static_cast<int>(i), 10 * static_cast<int>(i)};
      GridGeometry part = large;
      part.origin = Eigen::Vector2d(-3507 + first.col, 1993 + first.row) * 0.01;
      part.cols = 200;
      part.rows = 200;
      const LogOddsGrid seen = resampled(source, part, at, {.rule = rule}).value();
      for (int row = 0; row < part.rows; ++row) {
        for (int col = 0; col < part.cols; ++col) {
          const Cell in_whole{first.col + col, first.row + row};
          ASSERT_EQ(seen.at({col, row}), whole.at(in_whole));
        }
      }
    }
  }
}

TEST(Resampling, FarFromTheOriginCellsOfOneSizeAreNotAveraged) {
  // 900 km away coordinates are exact to 1e-10 m, 1e-8 cells.
  const GridGeometry target{
      .resolution_m = 0.01, .origin = {900'000, -900'000}, .cols = 9, .rows = 9};
  const LogOddsGrid source = random_grid(sized(9, 9, 0.01), 3, 9000);
  const LogOddsGrid shifted = resampled(source, target, pose(900'000, -900'000)).value();
  EXPECT_TRUE(std::ranges::equal(shifted.cells(), source.cells()));
}

}  // namespace
}  // namespace hypermap
