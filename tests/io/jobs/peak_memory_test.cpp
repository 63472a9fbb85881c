// SPDX-License-Identifier: BSD-3-Clause
#include "peak_memory.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

TEST(PeakMemory, GrowsByWhatWasTouchedAndStays) {
  constexpr std::size_t kBytes = std::size_t{64} << 20U;
  const std::size_t before = peak_rss_bytes();
  EXPECT_GT(before, 0U);
  char last = 0;
  { last = std::vector<char>(before + kBytes, 'x').back(); }
  EXPECT_EQ(last, 'x');
  EXPECT_GE(peak_rss_bytes(), before + kBytes);
}

}  // namespace
}  // namespace hypermap
