// SPDX-License-Identifier: BSD-3-Clause
#include "box_candidates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

/// Rows of one box; every second has the score 0.5, the others half as much and 1e-6 a row more.
class ManyRows final : public NetworkRows {
 public:
  [[nodiscard]] std::size_t size() const noexcept override { return 30'000; }
  [[nodiscard]] RowScores scores(std::size_t row) const override {
    return {.score = row % 2 == 1 ? 0.5 : 0.25 + 1e-6 * static_cast<double>(row)};
  }
  [[nodiscard]] PixelBox box_px(std::size_t /*row*/) const override { return {0, 0, 10, 10}; }
};

TEST(BoxCandidates, TheBestOfTooManyAreTaken) {
  const auto found = candidates_of(ManyRows(), 0.1);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), kMaxCandidates);
  for (std::size_t i = 0; i < found->size(); ++i) EXPECT_EQ((*found)[i].row, 2 * i + 1);
  EXPECT_EQ(suppress_overlaps(*found, 0.5).size(), 1U);
}

}  // namespace
}  // namespace hypermap
