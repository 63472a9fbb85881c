// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/progress_line.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace hypermap {
namespace {

constexpr double kNeverS = std::numeric_limits<double>::infinity();

TEST(ProgressText, DurationsAreRoundedUpToTheLastUnitShown) {
  EXPECT_EQ(duration_text(0.0), "0 s");
  EXPECT_EQ(duration_text(0.01), "1 s");
  EXPECT_EQ(duration_text(59.0), "59 s");
  EXPECT_EQ(duration_text(59.2), "1 min 00 s");
  EXPECT_EQ(duration_text(185.0), "3 min 05 s");
  EXPECT_EQ(duration_text(3599.0), "59 min 59 s");
  EXPECT_EQ(duration_text(3599.5), "1 h 00 min");
  EXPECT_EQ(duration_text(7200.0 + 241.0), "2 h 05 min") << "4 min 1 s are more than 4 min";
  EXPECT_EQ(duration_text(3600.0 * 27.0), "27 h 00 min");
  EXPECT_EQ(duration_text(3600.0 * 1000.0), "1000 h 00 min");
  EXPECT_EQ(duration_text(3600.0 * 1000.1), "over 1000 h");
  EXPECT_EQ(duration_text(kNeverS), "over 1000 h");
}

TEST(ProgressText, RatesHaveThreeDigitsOrTurnIntoTimes) {
  EXPECT_EQ(rate_text(412.3), "412 a second");
  EXPECT_EQ(rate_text(99.96), "100 a second");
  EXPECT_EQ(rate_text(41.2), "41.2 a second");
  EXPECT_EQ(rate_text(1.0), "1.0 a second");
  EXPECT_EQ(rate_text(0.96), "1.0 a second");
  EXPECT_EQ(rate_text(0.8), "1.2 s each") << "1.25 s, a tie, goes to the even digit";
  EXPECT_EQ(rate_text(0.05), "20.0 s each");
  EXPECT_EQ(rate_text(1.0 / 59.97), "1 min 00 s each");
  EXPECT_EQ(rate_text(1.0 / 184.5), "3 min 05 s each");
}

TEST(ProgressText, OneLineSaysHowFarHowFastAndHowLong) {
  EXPECT_EQ(progress_text("mapping", 1, 40, std::nullopt), "mapping 1/40 (2 %)");
  // 80 units at 41.2 a second take 1.94 s.
  EXPECT_EQ(progress_text("mapping", 120, 200, 41.2),
            "mapping 120/200 (60 %), 41.2 a second, 2 s left");
  // 9000 units at 0.5 a second take 18,000 s.
  EXPECT_EQ(progress_text("detecting", 1000, 10000, 0.5),
            "detecting 1000/10000 (10 %), 2.0 s each, 5 h 00 min left");
  EXPECT_EQ(progress_text("mapping", 200, 200, 41.2), "mapping 200/200 (100 %), 41.2 a second");
}

TEST(ProgressRate, SaysNothingBeforeItCanTell) {
  ProgressRate rate;
  EXPECT_EQ(rate.per_second(), std::nullopt);
  rate.note(100.0, 7);
  EXPECT_EQ(rate.per_second(), std::nullopt);
  rate.note(101.0, 50);
  EXPECT_EQ(rate.per_second(), std::nullopt) << "one second is too short";
  rate.note(102.0, 51);
  EXPECT_EQ(rate.per_second(), 22.0) << "44 units in 2 s; the 7 before were there already";
  ProgressRate slow;
  slow.note(0.0, 0);
  slow.note(40.0, 2);
  EXPECT_EQ(slow.per_second(), std::nullopt) << "two units are too few";
  slow.note(60.0, 3);
  EXPECT_EQ(slow.per_second(), 0.05);
}

TEST(ProgressRate, OnlyTheLastHalfMinuteCounts) {
  ProgressRate rate;
  std::size_t done = 0;
  // A minute at 10 a second, then at 2 a second.
  for (int second = 0; second <= 60; ++second, done += 10) rate.note(second, done);
  done -= 10;
  EXPECT_EQ(rate.per_second(), 10.0);
  for (int second = 61; second <= 75; ++second) rate.note(second, done += 2);
  // From second 45 on: 15 s at 10 a second and 15 s at 2, 180 units in 30 s.
  EXPECT_EQ(rate.per_second(), 6.0);
  for (int second = 76; second <= 120; ++second) rate.note(second, done += 2);
  EXPECT_EQ(rate.per_second(), 2.0);
}

TEST(ProgressRate, WhereUnitsAreSlowTheLastThreeCount) {
  ProgressRate rate;
  rate.note(0.0, 0);
  rate.note(100.0, 1);
  rate.note(200.0, 2);
  rate.note(300.0, 3);
  EXPECT_EQ(rate.per_second(), 0.01);
  rate.note(340.0, 4);
  // From second 100 on: 3 units in 240 s.
  EXPECT_EQ(rate.per_second(), 0.0125);
}

TEST(ProgressRate, ManyNotesInAMomentAreOne) {
  ProgressRate rate;
  for (int i = 0; i <= 4000; ++i) rate.note(0.001 * i, static_cast<std::size_t>(i));
  ASSERT_TRUE(rate.per_second());
  EXPECT_NEAR(*rate.per_second(), 1000.0, 1e-6);
}

TEST(ProgressLine, IsDueWithEachNewPercent) {
  ProgressLine line("mapping", kNeverS);
  EXPECT_EQ(line.update(0.0, 1, 400), "mapping 1/400 (0 %)");
  EXPECT_EQ(line.update(0.1, 2, 400), std::nullopt);
  EXPECT_EQ(line.update(1000.0, 3, 400), std::nullopt);
  // 3 units in 1001 s; 396 units take 132,132 s, which are 36 h 42 min and 12 s.
  EXPECT_EQ(line.update(1001.0, 4, 400), "mapping 4/400 (1 %), 5 min 34 s each, 36 h 43 min left");
  EXPECT_EQ(line.update(1001.0, 0, 0), std::nullopt);
}

TEST(ProgressLine, IsRefreshedBetweenTwoPercents) {
  ProgressLine line("mapping", 0.5);
  EXPECT_TRUE(line.update(0.0, 1, 4000));
  EXPECT_FALSE(line.update(0.25, 2, 4000));
  EXPECT_EQ(line.update(0.5, 3, 4000), "mapping 3/4000 (0 %)");
  EXPECT_FALSE(line.update(0.75, 4, 4000));
  EXPECT_TRUE(line.update(1.0, 5, 4000));
}

}  // namespace
}  // namespace hypermap
