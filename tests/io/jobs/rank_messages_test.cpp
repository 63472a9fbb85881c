// SPDX-License-Identifier: BSD-3-Clause
#include "rank_messages.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <variant>

namespace hypermap {
namespace {

TEST(RankMessages, AreReadAsTheyWereWritten) {
  const auto ready = parse_rank_says(write_rank_says(RankIsReady{"job"}));
  ASSERT_TRUE(ready);
  EXPECT_EQ(std::get<RankIsReady>(*ready).job, "job");
  const auto cannot = parse_rank_says(
      write_rank_says(RankCannotBegin{{.code = ErrorCode::kIo, .what = "why", .line = 3}}));
  ASSERT_TRUE(cannot);
  EXPECT_EQ(std::get<RankCannotBegin>(*cannot).error.code, ErrorCode::kIo);
  EXPECT_EQ(std::get<RankCannotBegin>(*cannot).error.line, 3);
  const auto done = parse_rank_says(write_rank_says(
      RankIsDone{{.number = 5, .note = "kept", .wall_s = 0.25, .peak_rss_bytes = 1U << 30U}}));
  ASSERT_TRUE(done);
  const TaskOutcome& outcome = std::get<RankIsDone>(*done).outcome;
  EXPECT_EQ(outcome.number, 5U);
  EXPECT_EQ(outcome.note, "kept");
  EXPECT_EQ(outcome.wall_s, 0.25);
  EXPECT_EQ(outcome.peak_rss_bytes, 1U << 30U);
  EXPECT_FALSE(outcome.error);
}

TEST(RankMessages, TasksAreNumbersOrNone) {
  EXPECT_EQ(parse_rank_task(write_rank_task(12)).value(), RankTask(12));
  EXPECT_EQ(parse_rank_task(write_rank_task(std::nullopt)).value(), std::nullopt);
}

TEST(RankMessages, OtherTextsAreRefused) {
  for (const char* text :
       {"", "{", "[]", "7", "{\"task\":\"x\"}", "{\"outcome\":{\"number\":1}}"}) {
    EXPECT_FALSE(parse_rank_says(text)) << text;
    EXPECT_FALSE(parse_rank_task(text)) << text;
  }
}

}  // namespace
}  // namespace hypermap
