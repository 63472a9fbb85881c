// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/log_odds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <limits>

namespace hypermap {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

static_assert(!std::convertible_to<double, Probability> && !std::convertible_to<double, LogOdds>);
static_assert(!std::convertible_to<Probability, LogOdds>);

// [smap] Eq. (3.10): ln(0.9 / 0.1) = ln 9 = 2.1972.
TEST(LogOdds, OfAProbabilityIsTheLogarithmOfItsOdds) {
  EXPECT_NEAR(LogOdds::of(Probability(0.9)).value(), 2.1972245773362196, 1e-12);
  EXPECT_EQ(LogOdds::of(Probability(0.5)).value(), 0.0);
  EXPECT_EQ(LogOdds::of(Probability(0.0)).value(), -kInf);
  EXPECT_EQ(LogOdds::of(Probability(1.0)).value(), kInf);
}

// [smap] Eq. (3.11): 1 - 1 / (1 + e^l); l = ln 9 gives 0.9.
TEST(LogOdds, GiveTheirProbabilityBack) {
  EXPECT_NEAR(LogOdds(std::log(9.0)).probability().value(), 0.9, 1e-12);
  for (const double p : {1e-12, 0.2, 0.5, 0.97}) {
    EXPECT_NEAR(LogOdds::of(Probability(p)).probability().value(), p, 1e-15);
  }
  EXPECT_EQ(LogOdds(1e6).probability().value(), 1.0);
  EXPECT_EQ(LogOdds(-1e6).probability().value(), 0.0);
  EXPECT_EQ(LogOdds(kInf).probability().value(), 1.0);
}

// Bayes with a prior of 0.5: odds 4 and 9 make 36, p = 36 / 37.
TEST(LogOdds, AddToFuseIndependentEvidence) {
  const LogOdds fused = LogOdds::of(Probability(0.8)) + LogOdds::of(Probability(0.9));
  EXPECT_NEAR(fused.probability().value(), 36.0 / 37.0, 1e-12);
  EXPECT_EQ((LogOdds(3) - LogOdds(1)).value(), 2.0);
  EXPECT_EQ((0.5 * LogOdds(3)).value(), 1.5);
}

}  // namespace
}  // namespace hypermap
