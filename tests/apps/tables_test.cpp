// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace hypermap::app {
namespace {

TEST(FixedApart, HasAsManyDigitsAsTellTwoNumbersApart) {
  EXPECT_EQ(fixed_apart(0.5, 0.75), (std::pair<std::string, std::string>("0.50", "0.75")));
  EXPECT_EQ(fixed_apart(0.4996, 0.5), (std::pair<std::string, std::string>("0.4996", "0.5000")));
  EXPECT_EQ(fixed_apart(0.5, 0.5), (std::pair<std::string, std::string>("0.50", "0.50")));
  EXPECT_EQ(fixed_apart(0.5, 0.5 + 1e-12),
            (std::pair<std::string, std::string>("0.500000000", "0.500000000")));
}

}  // namespace
}  // namespace hypermap::app
