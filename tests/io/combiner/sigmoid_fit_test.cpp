// SPDX-License-Identifier: BSD-3-Clause
#include "sigmoid_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

// Two groups, at 0 and at 1: three of four positive at 1, one of four at 0. All 8 have n+ = n- = 4,
// so targets are 5/6 and 1/6, and the fit goes through the mean target of each group:
// at 1 (3 * 5/6 + 1/6) / 4 = 2/3, at 0 1/3. logit(1/3) = -log 2, logit(2/3) = log 2.
TEST(SigmoidFit, GoesThroughTheShareOfEachDistance) {
  const std::vector<double> distances{1, 1, 1, 1, 0, 0, 0, 0};
  const std::array<bool, 8> are_positive{true, true, true, false, true, false, false, false};
  const Sigmoid sigmoid = fit_sigmoid(distances, are_positive);
  EXPECT_NEAR(sigmoid.offset, -std::log(2.0), 1e-6);
  EXPECT_NEAR(sigmoid.slope, 2.0 * std::log(2.0), 1e-6);
}

TEST(SigmoidFit, ASideThatIsNegativeTurnsTheSlope) {
  const std::vector<double> distances{-1, -1, -1, -1, 0, 0, 0, 0};
  const std::array<bool, 8> are_positive{true, true, true, false, true, false, false, false};
  EXPECT_NEAR(fit_sigmoid(distances, are_positive).slope, -2.0 * std::log(2.0), 1e-6);
}

// Apart as far as one likes, the slope stays finite: the targets are not 0 and 1.
TEST(SigmoidFit, WhatIsApartHasAFiniteSlope) {
  const std::vector<double> distances{-2, -1, 1, 2};
  const std::array<bool, 4> are_positive{false, false, true, true};
  const Sigmoid sigmoid = fit_sigmoid(distances, are_positive);
  EXPECT_GT(sigmoid.slope, 0.1);
  EXPECT_LT(sigmoid.slope, 10.0);
  EXPECT_NEAR(sigmoid.offset, 0.0, 1e-6);
}

TEST(SigmoidFit, OneDistanceAloneGivesTheShare) {
  const std::vector<double> distances{3, 3, 3, 3};
  const std::array<bool, 4> are_positive{true, false, false, false};
  const Sigmoid sigmoid = fit_sigmoid(distances, are_positive);
  // n+ = 1, n- = 3: targets 2/3 and 1/5, in the mean (2/3 + 3/5) / 4 = 19/60.
  const double log_odds = 3.0 * sigmoid.slope + sigmoid.offset;
  EXPECT_NEAR(1.0 / (1.0 + std::exp(-log_odds)), 19.0 / 60.0, 1e-6);
}

}  // namespace
}  // namespace hypermap
