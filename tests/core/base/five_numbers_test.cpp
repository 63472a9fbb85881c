// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/five_numbers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

TEST(FiveNumbers, QuartilesLieBetweenValues) {
  // In order 1, 2, 4, 8: places 0.75, 1.5 and 2.25.
  EXPECT_EQ(five_numbers(std::vector{8.0, 1.0, 4.0, 2.0}), (FiveNumbers{1, 1.75, 3, 5, 8}));
}

TEST(FiveNumbers, OfFiveValuesTheyAreTheValues) {
  EXPECT_EQ(five_numbers(std::vector{5.0, 3.0, 1.0, 2.0, 4.0}), (FiveNumbers{1, 2, 3, 4, 5}));
}

TEST(FiveNumbers, OfOneValueAllAreItAndOfNoneNothing) {
  EXPECT_EQ(five_numbers(std::vector{7.0}), (FiveNumbers{7, 7, 7, 7, 7}));
  EXPECT_EQ(five_numbers({}), FiveNumbers{});
}

}  // namespace
}  // namespace hypermap
