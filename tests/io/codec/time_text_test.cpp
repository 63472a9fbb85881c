// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/time_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

TEST(TimeText, SecondsAreReadToTheNanosecond) {
  EXPECT_EQ(parse_time("12.5"), (WrittenTime{.stamp = {12'500'000'000}}));
  EXPECT_EQ(parse_time("0"), WrittenTime{});
  EXPECT_EQ(parse_time("1341841278.842748000"),
            (WrittenTime{.stamp = {1'341'841'278'842'748'000}}));
}

/// By hand: 15530 days from 1970 to 2012-07-09 (42 years of 365 days, 10 leap days, 190 days of
/// that leap year before it), 13:41:18 of the day.
constexpr std::int64_t kJulyMorningNs =
    ((42LL * 365 + 10 + 190) * 86400LL + 13LL * 3600 + 41LL * 60 + 18) * 1'000'000'000;

TEST(TimeText, DatesAreReadInUtc) {
  EXPECT_EQ(kJulyMorningNs, 1'341'841'278'000'000'000);
  EXPECT_EQ(parse_time("2012-07-09T13:41:18Z"),
            (WrittenTime{.stamp = {kJulyMorningNs}, .is_date = true}));
  EXPECT_EQ(parse_time("2012-07-09T13:41:18.842748Z"),
            (WrittenTime{.stamp = {kJulyMorningNs + 842'748'000}, .is_date = true}));
  EXPECT_EQ(parse_time("2012-07-09T13:41Z"),
            (WrittenTime{.stamp = {kJulyMorningNs - 18'000'000'000}, .is_date = true}));
  EXPECT_EQ(parse_time("1970-01-01T00:00:00Z"), (WrittenTime{.is_date = true}));
  EXPECT_TRUE(parse_time("2012-02-29T00:00Z"));
}

TEST(TimeText, WhatIsNoMomentIsRefusedWithItsText) {
  for (const char* text : {"",
                           "noon",
                           "nan",
                           "inf",
                           "-1",
                           "12,5",
                           "12.5s",
                           "2012-07-09",
                           "2012-07-09T13:41:18",
                           "2012-07-09T13:41:18+02:00",
                           "2012-07-09 13:41:18Z",
                           "2012-07-09T13Z",
                           "2012-07-09T13:4Z",
                           "2012-07-09T13:41:Z",
                           "2012-07-09T13:41:1Z",
                           "2012-07-09T13:41:18.Z",
                           "2012-07-09T13:41:+1Z",
                           "2012-07-09T13:41:60Z",
                           "2012-07-09T13:60:00Z",
                           "2012-07-09T24:00:00Z",
                           "2011-02-29T00:00Z",
                           "2012-13-01T00:00Z",
                           "2012-00-01T00:00Z",
                           "1969-12-31T23:59:59Z",
                           "2262-01-01T00:00:00Z",
                           "Z"}) {
    const auto refused = parse_time(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(to_string(refused.error()), HasSubstr("'" + std::string(text) + "'"));
  }
}

TEST(TimeText, SecondsAreWrittenExactly) {
  EXPECT_EQ(seconds_text({0}), "0.0");
  EXPECT_EQ(seconds_text({1'341'841'278'842'748'000}), "1341841278.842748");
  EXPECT_EQ(seconds_text({-1'500'000'000}), "-1.5");
  EXPECT_EQ(seconds_text({-1}), "-0.000000001");
  EXPECT_EQ(seconds_text({std::numeric_limits<std::int64_t>::min()}), "-9223372036.854775808");
}

TEST(TimeText, WhatIsWrittenIsReadBack) {
  for (std::int64_t ns = 1'000'000'000'000'000'000; ns < 9'100'000'000'000'000'000;
       ns += 98'765'432'101'234'567) {
    const Stamp stamp{ns};
    EXPECT_EQ(parse_time(seconds_text(stamp)), (WrittenTime{.stamp = stamp})) << ns;
    EXPECT_EQ(parse_time(date_text(stamp)), (WrittenTime{.stamp = stamp, .is_date = true}))
        << date_text(stamp);
  }
  EXPECT_EQ(date_text({kJulyMorningNs}), "2012-07-09T13:41:18Z");
}

TEST(TimeText, AClockThatCountsFrom1970IsToldFromOneThatCountsFromItsStart) {
  EXPECT_TRUE(is_since_1970({kJulyMorningNs}));
  EXPECT_FALSE(is_since_1970({33'000'000'000}));
}

}  // namespace
}  // namespace hypermap
