// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/deadline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap {
namespace {

TEST(Deadline, LifetimesAreThoseOfTheSource) {
  // [smap] Eq. (F.1): 1000 e^(-1 / 1.738) = 562.5 ms, 1000 e^(-2 / 1.738) = 316.4 ms.
  EXPECT_NEAR(object_lifetime_s(1), 0.5625, 5e-5);
  EXPECT_NEAR(object_lifetime_s(2), 0.3164, 5e-5);
  EXPECT_NEAR(object_lifetime_s(8), 0.0100, 5e-5);
  EXPECT_EQ(object_lifetime_s(0), object_lifetime_s(1));
  EXPECT_EQ(object_lifetime_s(20), object_lifetime_s(8)) << "never more than 8 threads";
}

TEST(Deadline, RulesSayWhen) {
  EXPECT_TRUE(std::isinf(deadline_s({}, 10)));
  EXPECT_EQ(deadline_s({.rule = DeadlineRule::kFixed, .frame_s = 0.02}, 10), 0.02);
  EXPECT_EQ(deadline_s({.rule = DeadlineRule::kSmap}, 3), object_lifetime_s(3));
}

TEST(Deadline, TimesThatAreNoneAreRefused) {
  EXPECT_TRUE(validate(DeadlineOptions{}));
  for (const double frame_s : {0.0, -1.0, 3601.0, std::nan("")}) {
    const auto refused =
        validate(DeadlineOptions{.rule = DeadlineRule::kFixed, .frame_s = frame_s});
    ASSERT_FALSE(refused) << frame_s;
    EXPECT_EQ(refused.error().field, "frame_s");
  }
}

}  // namespace
}  // namespace hypermap
