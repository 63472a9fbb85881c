// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/class_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

ClassSize cup() {
  return {.longer = LengthRange{0.06, 0.16},
          .shorter = LengthRange{0.05, 0.12},
          .height = LengthRange{0.05, 0.16}};
}

// [smap] Eq. (3.17), p(x) of a size: by hand.
TEST(SizeLogFactor, IsTheTailOfALogNormalBeyondTheRange) {
  // 35 cm high: (0.35 - 0.03) / 0.16 = 2, ln 2 / ln 1.25 = 3.106, squared and halved 4.824.
  const double tall = -0.5 * std::pow(std::log(2.0) / std::log(1.25), 2);
  EXPECT_NEAR(size_log_factor(cup(), {0.09, 0.09, 0.35}, false), tall, 1e-9);
  EXPECT_NEAR(tall, -4.8245, 1e-4);
  // And 35 cm long, which is as much too long; and 15 cm wide, which 3 cm of noise explain.
  EXPECT_NEAR(size_log_factor(cup(), {0.35, 0.15, 0.35}, false), 2.0 * tall, 1e-9);
}

TEST(SizeLogFactor, WithinTheRangeItIsNothing) {
  EXPECT_EQ(size_log_factor(cup(), {0.06, 0.05, 0.05}, true), 0.0);
  EXPECT_EQ(size_log_factor(cup(), {0.19, 0.15, 0.19}, true), 0.0) << "3 cm more are noise";
  EXPECT_EQ(size_log_factor(cup(), {0.03, 0.02, 0.02}, true), 0.0) << "as are 3 cm less";
  EXPECT_EQ(size_log_factor(ClassSize{}, {9.0, 9.0, 9.0}, true), 0.0);
}

TEST(SizeLogFactor, WhatIsTooSmallCountsWhereItWasSeenWhole) {
  const ClassSize sofa{.longer = LengthRange{1.2, 3.5}};
  const Eigen::Vector3d chair(0.57, 0.5, 0.9);  // 1.2 / (0.57 + 0.03) is 2
  EXPECT_EQ(size_log_factor(sofa, chair, false), 0.0);
  EXPECT_NEAR(
      size_log_factor(sofa, chair, true), -0.5 * std::pow(std::log(2.0) / std::log(1.25), 2), 1e-9);
}

TEST(ClassSizes, AreChecked) {
  const auto error_of = [](const char* name, const ClassSize& size) {
    return validate(ClassSizes{{name, size}}).error();
  };
  EXPECT_TRUE(validate(ClassSizes{{"cup", cup()}}));
  EXPECT_TRUE(validate(ClassSizes{{"cup", {.height = LengthRange{0.1, 0.1}}}}));
  EXPECT_EQ(error_of("Cup", cup()).field, "sizes.Cup");
  EXPECT_EQ(error_of("cup", {}).field, "sizes.cup");
  for (const LengthRange& range : {LengthRange{0.0, 0.1},
                                   LengthRange{0.2, 0.1},
                                   LengthRange{0.1, 101.0},
                                   LengthRange{std::numeric_limits<double>::quiet_NaN(), 0.1},
                                   LengthRange{0.1, std::numeric_limits<double>::infinity()}}) {
    EXPECT_EQ(error_of("cup", {.shorter = range}).field, "sizes.cup.shorter");
  }
}

}  // namespace
}  // namespace hypermap
