// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/count_text.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(CountText, OneAloneIsSingular) {
  EXPECT_EQ(count_text(0, "frame"), "0 frames");
  EXPECT_EQ(count_text(1, "frame"), "1 frame");
  EXPECT_EQ(count_text(2, "frame"), "2 frames");
  EXPECT_EQ(count_text(11, "true object"), "11 true objects");
}

}  // namespace
}  // namespace hypermap
