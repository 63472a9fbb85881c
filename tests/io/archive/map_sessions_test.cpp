// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_sessions.hpp"

#include "io/archive/two_sessions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::two_sessions;
using ::testing::HasSubstr;

TEST(MapSessions, GoByNameElseByNumber) {
  const auto runs = two_sessions(30);
  EXPECT_EQ(find_session(runs, "morning")->number, 1U);
  EXPECT_EQ(find_session(runs, "2")->frames, (FrameRange{.first = 30}));
  const auto unknown = find_session(runs, "evening");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(to_string(unknown.error()),
              HasSubstr("'evening'; it has morning (0.0 .. 29.0 s), 2 (30.0 .. 59.0 s)"));
  EXPECT_FALSE(find_session(runs, "1")) << "it has a name";
  EXPECT_THAT(to_string(find_session({}, "1").error()), HasSubstr("does not tell of any"));
}

TEST(MapSessions, NamesOfSeveralAreKnown) {
  auto runs = two_sessions(30);
  EXPECT_THAT(names_of_several(sessions_of(runs)), testing::IsEmpty());
  runs[1].session = runs[0].session;
  runs.emplace_back();
  runs.emplace_back();
  EXPECT_THAT(names_of_several(sessions_of(runs)), testing::ElementsAre("morning"));
}

TEST(MapSessions, FilesThatWereImportedAreNone) {
  auto runs = two_sessions(30);
  Provenance imported;
  imported.options = make_map({{"import", make_map({{"layers", make_list({})}})}});
  EXPECT_TRUE(is_import(imported));
  EXPECT_FALSE(is_import(runs[0]));
  runs.insert(runs.begin(), imported);
  const auto sessions = sessions_of(runs);
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].number, 1U);
  EXPECT_EQ(session_of_frame(sessions, 29)->name, "morning");
  EXPECT_EQ(session_of_frame(sessions, 30)->number, 2U);
}

TEST(MapSessions, AFrameIsOfTheSessionThatCountsIt) {
  const auto sessions = sessions_of(two_sessions(30));
  EXPECT_EQ(session_of_frame(sessions, 0)->name, "morning");
  EXPECT_EQ(session_of_frame(sessions, 29)->name, "morning");
  EXPECT_EQ(session_of_frame(sessions, 30)->number, 2U);
  auto runs = two_sessions(30);
  runs[0].next_frame_index = 0;
  EXPECT_FALSE(session_of_frame(sessions_of(runs), 5)) << "nobody kept where it ends";
}

TEST(MapSessions, FollowEachOtherWhereEachBeginsAfterTheOneBefore) {
  EXPECT_TRUE(follow_each_other(sessions_of(two_sessions(30))));
  EXPECT_TRUE(follow_each_other(sessions_of(two_sessions(29)))) << "at the same moment";
  EXPECT_FALSE(follow_each_other(sessions_of(two_sessions(28))));
  EXPECT_FALSE(follow_each_other(sessions_of(two_sessions(-100)))) << "mapped in another order";
  auto runs = two_sessions(0);
  runs[1].first_stamp.reset();
  EXPECT_TRUE(follow_each_other(sessions_of(runs))) << "as far as the map tells";
}

TEST(MapSessions, OneWithoutTimesGoesByItsName) {
  auto runs = two_sessions(30);
  runs[0].last_stamp.reset();
  EXPECT_EQ(to_string(sessions_of(runs)), "morning, 2 (30.0 .. 59.0 s)");
}

}  // namespace
}  // namespace hypermap
