// SPDX-License-Identifier: BSD-3-Clause
// Values between cells; whole grids are in resampling_test.cpp.
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/projection/stack/resampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hypermap {
namespace {

constexpr std::array kRules{
    ResamplingRule::kNearest, ResamplingRule::kBilinear, ResamplingRule::kBiodds};

LogOdds logit(double p) {
  return LogOdds::of(Probability(p));
}

double biodds(const CellSquare& square, double x, double y, double epsilon) {
  const ResamplingOptions options{ResamplingRule::kBiodds, Probability(epsilon)};
  return interpolated(square, x, y, options).probability().value();
}

/// [sogm] Eq. (4) and its inverse.
double model(double x, double alpha) {
  return 0.5 * std::tanh((x - 0.5) * alpha) + 0.5;
}
double inverse_model(double p, double alpha) {
  return std::atanh(2.0 * (p - 0.5)) / alpha + 0.5;
}

/// [sogm] Eq. (5) as printed, for the square from (0, 0) to (1, 1); p[x][y].
double printed_biodds(const std::array<std::array<double, 2>, 2>& p, double x, double y, double e) {
  const double alpha = std::log((1.0 - e) / e);
  const auto kept = [&](double value) { return std::clamp(value, e, 1.0 - e); };
  const auto along_x = [&](int row) {
    const auto r = static_cast<std::size_t>(row);
    return model(
        x * inverse_model(kept(p[1][r]), alpha) + (1.0 - x) * inverse_model(kept(p[0][r]), alpha),
        alpha);
  };
  return model(y * inverse_model(along_x(1), alpha) + (1.0 - y) * inverse_model(along_x(0), alpha),
               alpha);
}

TEST(Biodds, TheHyperbolicFunctionIsTheOddsModelItself) {
  // [sogm] Eq. (3): Odd(R) = Odd(e0) Odd(0.5 + e1)^R, R from 0 to R_max, where it is Odd(1 - e0).
  // With x = R / R_max it is Eq. (4), whatever e1. Erratum of resampling.hpp.
  for (const double e0 : {0.001, 0.05, 0.3}) {
    for (const double e1 : {0.01, 0.2}) {
      const double alpha = std::log((1.0 - e0) / e0);
      const double r_max = (logit(1.0 - e0).value() - logit(e0).value()) / logit(0.5 + e1).value();
      for (const double x : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const LogOdds odds(logit(e0).value() + x * r_max * logit(0.5 + e1).value());
        EXPECT_NEAR(model(x, alpha), odds.probability().value(), 1e-12);
      }
    }
  }
}

TEST(Biodds, IsThePrintedFormulaAndBilinearInClampedLogOdds) {
  // [sogm] Eq. (4), Eq. (5) as printed against what is computed, and against bilinear interpolation
  // of clamped log-odds written out.
  CounterRng random(3, 1);
  for (int i = 0; i < 2000; ++i) {
    const double e = random.uniform(1e-6, 0.499);
    std::array<std::array<double, 2>, 2> p{};
    for (auto& column : p) {
      for (double& value : column) value = random.uniform();
    }
    const double x = random.uniform();
    const double y = random.uniform();
    const CellSquare square{logit(p[0][0]), logit(p[1][0]), logit(p[0][1]), logit(p[1][1])};
    const double computed = biodds(square, x, y, e);
    ASSERT_NEAR(computed, printed_biodds(p, x, y, e), 1e-9);
    const auto kept = [&](double value) {
      return std::clamp(logit(value).value(), logit(e).value(), -logit(e).value());
    };
    const double by_hand = (1 - x) * (1 - y) * kept(p[0][0]) + x * (1 - y) * kept(p[1][0]) +
                           (1 - x) * y * kept(p[0][1]) + x * y * kept(p[1][1]);
    ASSERT_NEAR(computed, LogOdds(by_hand).probability().value(), 1e-12);
  }
}

TEST(Biodds, AHandWorkedPoint) {
  // [sogm] Eq. (5): a row of p = 0.9 beside p = 0.2, y between equal rows. ln 9 = 2.197 225,
  // ln 0.25 = -1.386 294. A quarter of the way from 0.2 to 0.9: -1.386 294 + 0.25 * 3.583 519 =
  // -0.490 415, p = 0.379 796.
  const CellSquare square{logit(0.2), logit(0.9), logit(0.2), logit(0.9)};
  EXPECT_NEAR(biodds(square, 0.25, 0.6, 1e-6), 0.379796, 1e-6);
}

TEST(Biodds, TendsToTheNearestCellBetweenSaturatedCells) {
  // [sogm] figure 3, Eq. (5) with e0 -> 0: a step half way between free and occupied.
  const LogOdds all(13.815);
  const CellSquare square{-1.0 * all, all, -1.0 * all, all};
  const ResamplingOptions nearest{ResamplingRule::kNearest, Probability(1e-6)};
  double worst_before = 1.0;
  for (const double e : {0.3, 1e-2, 1e-4, 1e-6}) {
    double worst = 0.0;
    for (const double x : {0.05, 0.2, 0.3, 0.7, 0.9}) {
      const double step = interpolated(square, x, 0.5, nearest).probability().value();
      worst = std::max(worst, std::abs(biodds(square, x, 0.5, e) - step));
    }
    EXPECT_LT(worst, worst_before) << e;
    worst_before = worst;
  }
  EXPECT_LT(worst_before, 0.005);  // logistic(-0.4 * 13.8155) = 0.003 97 at x = 0.3
}

TEST(Biodds, TendsToBilinearBetweenTheBounds) {
  // [sogm] figure 3, Eq. (5) with e0 -> 0.5: linear from e0 to 1 - e0.
  const LogOdds all(13.815);
  const CellSquare square{-1.0 * all, all, all, -1.0 * all};
  double worst_before = 1.0;
  for (const double e : {0.01, 0.1, 0.3, 0.45, 0.49}) {
    double worst = 0.0;
    for (const double x : {0.0, 0.1, 0.4, 0.8, 1.0}) {
      for (const double y : {0.0, 0.25, 0.9}) {
        const double bilinear = x * (1 - y) + (1 - x) * y;  // of 0, 1, 1, 0
        const double scaled = (biodds(square, x, y, e) - e) / (1.0 - 2.0 * e);
        worst = std::max(worst, std::abs(scaled - bilinear));
      }
    }
    EXPECT_LT(worst, worst_before) << e;
    worst_before = worst;
  }
  EXPECT_LT(worst_before, 1e-4);
}

TEST(Interpolation, IsMonotoneAndWithinItsCellsByEveryRule) {
  CounterRng random(5, 2);
  for (int i = 0; i < 3000; ++i) {
    std::array<LogOdds, 4> cells;
    for (LogOdds& l : cells) l = LogOdds(random.uniform(-14.0, 14.0));
    const double x = random.uniform();
    const double y = random.uniform();
    for (const ResamplingRule rule : kRules) {
      const ResamplingOptions options{rule, Probability(random.uniform(1e-6, 0.4))};
      const double bound = -logit(options.epsilon.value()).value();
      const double value =
          interpolated({cells[0], cells[1], cells[2], cells[3]}, x, y, options).value();
      const auto [low, high] = std::ranges::minmax(cells);
      ASSERT_GE(value, std::clamp(low.value(), -bound, bound) - 1e-9);
      ASSERT_LE(value, std::clamp(high.value(), -bound, bound) + 1e-9);
      auto more = cells;
      more[random.below(4)] += LogOdds(random.uniform(0.0, 3.0));
      const LogOdds raised = interpolated({more[0], more[1], more[2], more[3]}, x, y, options);
      ASSERT_GE(raised.value(), value - 1e-9);
    }
  }
}

TEST(Interpolation, HalfWayTheUpperCellIsTheNearest) {
  const ResamplingOptions options{ResamplingRule::kNearest, Probability(1e-6)};
  const CellSquare square{LogOdds(1.0), LogOdds(2.0), LogOdds(3.0), LogOdds(4.0)};
  EXPECT_EQ(interpolated(square, 0.5, 0.5, options), LogOdds(4.0));
  EXPECT_EQ(interpolated(square, 0.49, 0.5, options), LogOdds(3.0));
  EXPECT_EQ(interpolated(square, 0.5, 0.49, options), LogOdds(2.0));
  EXPECT_EQ(interpolated(square, 0.49, 0.49, options), LogOdds(1.0));
}

TEST(Interpolation, BilinearIsOfProbabilities) {
  // 0.25 * 0.9 + 0.75 * 0.1 = 0.3.
  const ResamplingOptions options{ResamplingRule::kBilinear, Probability(1e-6)};
  const CellSquare square{logit(0.1), logit(0.9), logit(0.1), logit(0.9)};
  EXPECT_NEAR(interpolated(square, 0.25, 0.5, options).probability().value(), 0.3, 1e-12);
}

}  // namespace
}  // namespace hypermap
