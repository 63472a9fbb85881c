// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/look_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

TEST(LookOptions, AreCheckedByName) {
  EXPECT_TRUE(validate(LookOptions{}));
  EXPECT_TRUE(validate(LookOptions{.rule = LookRule::kKeyframes}));
  EXPECT_THAT(to_string(validate(LookOptions{.every = 0}).error()), HasSubstr("every"));
  EXPECT_THAT(to_string(validate(LookOptions{.min_angle_rad = -0.1}).error()),
              HasSubstr("min_angle_rad"));
  EXPECT_THAT(to_string(validate(LookOptions{.rule = LookRule::kKeyframes, .every = 2}).error()),
              HasSubstr("must be 1 with keyframes, is 2"));
}

}  // namespace
}  // namespace hypermap
