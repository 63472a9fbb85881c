// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/position_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace hypermap {
namespace {

TEST(PositionErrors, ByHand) {
  // Distances 5 and 13: mean 9, each 4 off it; squares (9 + 25, 16 + 144, 0) / 2.
  const std::vector<Eigen::Vector3d> errors{{3, 4, 0}, {5, -12, 0}};
  const PositionErrorSummary summary = summarised(errors);
  EXPECT_EQ(summary.n, 2U);
  EXPECT_TRUE(summary.mean_m->isApprox(Eigen::Vector3d(4, -4, 0)));
  EXPECT_DOUBLE_EQ(*summary.mean_distance_m, 9.0);
  EXPECT_DOUBLE_EQ(*summary.std_distance_m, std::sqrt(32.0));
  EXPECT_TRUE(summary.rmse_m->isApprox(Eigen::Vector3d(std::sqrt(17.0), std::sqrt(80.0), 0.0)));
  EXPECT_DOUBLE_EQ(*summary.total_rmse_m, std::sqrt(97.0));
}

TEST(PositionErrors, OfNoneNothingAndOfOneNoDeviation) {
  const PositionErrorSummary none = summarised({});
  EXPECT_EQ(none.n, 0U);
  EXPECT_FALSE(none.mean_m || none.mean_distance_m || none.rmse_m || none.total_rmse_m);
  const PositionErrorSummary one = summarised(std::vector<Eigen::Vector3d>{{0, 0, -2}});
  EXPECT_DOUBLE_EQ(*one.total_rmse_m, 2.0);
  EXPECT_FALSE(one.std_distance_m);
}

// [smap] table 5.2 as printed: its sums of squares are what it calls RMSE.
TEST(PositionErrors, TheTextsTableLacksMeanAndRoot) {
  const std::vector<Eigen::Vector3d> printed{{1.49, -0.14, 0.13},
                                             {0.02, -0.01, 0.02},
                                             {-0.02, -0.02, -0.01},
                                             {-0.15, 0.21, 0.05},
                                             {0.04, -0.03, 0.03},
                                             {0.01, 0.03, 0.03},
                                             {0.33, -0.31, -0.12},
                                             {0.02, -0.04, 0.03},
                                             {0.03, -0.02, 0.02},
                                             {0.00, 0.02, 0.30},
                                             {-0.02, 0.03, 0.26},
                                             {-0.02, -0.04, -0.02},
                                             {0.01, 0.01, 0.23},
                                             {0.01, -0.01, 0.23}};
  const PositionErrorSummary all = summarised(printed);
  const Eigen::Vector3d sums = 14.0 * all.rmse_m->cwiseAbs2();
  EXPECT_TRUE(sums.isApprox(Eigen::Vector3d(2.36, 0.17, 0.30), 5e-3)) << sums.transpose();
  EXPECT_NEAR(std::sqrt(sums.sum() / 15.0), 0.43, 5e-3);
  EXPECT_NEAR(*all.total_rmse_m, 0.45, 5e-3);
  const PositionErrorSummary without_first = summarised(std::span(printed).subspan(1));
  const Eigen::Vector3d fewer = 13.0 * without_first.rmse_m->cwiseAbs2();
  EXPECT_TRUE(fewer.isApprox(Eigen::Vector3d(0.14, 0.15, 0.28), 2e-2)) << fewer.transpose();
  EXPECT_NEAR(std::sqrt(fewer.sum() / 14.0), 0.20, 5e-3);
  EXPECT_NEAR(*without_first.total_rmse_m, 0.209, 5e-4);
}

}  // namespace
}  // namespace hypermap
