// SPDX-License-Identifier: BSD-3-Clause
// What logs tell of the past, against whole histories at random.
#include "history_logs.hpp"
#include "hypermap/core/objects/object_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace hypermap {
namespace {

using namespace testing_support;  // NOLINT(google-build-using-namespace): logs in words

/// A history of `count` frames in sessions of `session` frames whose clocks all begin at 0.
std::vector<ObservationLogEntry> random_history(std::mt19937& random,
                                                std::int64_t count,
                                                std::int64_t session) {
  std::vector<ObservationLogEntry> entries;
  for (std::int64_t frame = 0; frame < count; ++frame) {
    if (random() % 3 == 0 && !entries.empty()) continue;
    ObservationLogEntry entry = detected_in(static_cast<std::uint64_t>(frame), frame % session);
    if (random() % 4 == 0 && !entries.empty()) {
      entry = absent_at(frame % session);
      entry.frame_index = static_cast<std::uint64_t>(frame);
      entry.visibility = random() % 2 == 0 ? Visibility::kAbsent : Visibility::kVisible;
      entry.score = entry.visibility == Visibility::kVisible ? 0.5F : 0.0F;
    }
    entry.class_id = ClassId{static_cast<std::uint32_t>(random() % 3)};
    entry.bearing_rad = static_cast<float>(random() % 6);
    entries.push_back(entry);
  }
  return entries;
}

TEST(ObjectHistory, EachMomentIsThatOfALogThatEndedThen) {
  std::mt19937 random(7);
  int num_whole = 0;
  for (int round = 0; round < 40; ++round) {
    const auto count = static_cast<std::int64_t>(20 + random() % 200);
    const auto entries = random_history(random, count, count);
    const ObservationLog whole = object_with_log(entries).observation_log;
    for (std::int64_t second = 0; second < count; ++second) {
      ObservationLog then;
      for (const ObservationLogEntry& entry : entries) {
        if (entry.stamp <= stamp_s(second)) then.add(entry);
      }
      const auto past = log_as_of(whole, moment_s(second));
      ASSERT_EQ(past.has_value(), then.state().first.has_value());
      if (!past || !past->is_whole) continue;
      ++num_whole;
      ASSERT_EQ(past->log.state().first, then.state().first);
      ASSERT_EQ(past->log.state().summaries.size(), then.state().summaries.size());
      for (std::size_t i = 0; i < then.state().summaries.size(); ++i) {
        EXPECT_EQ(past->log.state().summaries[i].count, then.state().summaries[i].count);
      }
      const auto was = detection_regularity(then);
      const auto is = detection_regularity(past->log);
      EXPECT_EQ(is.num_detections, was.num_detections);
      EXPECT_EQ(is.num_directions, was.num_directions);
      EXPECT_EQ(is.num_named_otherwise, was.num_named_otherwise);
      EXPECT_NEAR(is.missed_visibility, was.missed_visibility, 1e-4);
      EXPECT_EQ(absence_run(past->log), absence_run(then));
    }
  }
  EXPECT_GT(num_whole, 2000) << "most moments are told";
}

TEST(ObjectHistory, TheMomentOfTheLastFrameIsNow) {
  std::mt19937 random(8);
  ObjectMap map;
  for (int i = 0; i < 20; ++i) map.add(object_with_log(random_history(random, 150, 150)));
  const PastObjects past = objects_as_of(map, moment_s(150));
  EXPECT_EQ(past.objects, map);
  EXPECT_TRUE(past.unknown.empty());
}

bool was_truly_seen(const std::vector<ObservationLogEntry>& entries, const ObservationSpan& span) {
  return std::ranges::any_of(entries, [&](const ObservationLogEntry& entry) {
    return entry.kind == ObservationKind::kDetection &&
           span.contains(entry.frame_index, entry.stamp);
  });
}

TEST(SeenIn, EachAnswerIsTrueOfTheWholeHistory) {
  std::mt19937 random(9);
  int num_unknown = 0;
  int num_asked = 0;
  for (int round = 0; round < 60; ++round) {
    const auto count = static_cast<std::int64_t>(30 + random() % 200);
    const bool has_sessions = round % 2 == 1;
    const std::int64_t session = has_sessions ? 25 : count;
    const auto entries = random_history(random, count, session);
    const Object object = object_with_log(entries);
    for (int i = 0; i < 60; ++i) {
      const auto since = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(session));
      const auto first =
          static_cast<std::uint64_t>(static_cast<std::int64_t>(random() % 8) * session);
      ObservationSpan span{.since = stamp_s(since), .until = stamp_s(since + 4), .frames = {}};
      if (has_sessions) span.frames = {first, first + static_cast<std::uint64_t>(session)};
      if (i % 5 == 0) span.since.reset();
      if (i % 7 == 0) span.until.reset();
      const Sighting told_as = was_seen_in(object, span);
      ++num_asked;
      num_unknown += told_as == Sighting::kUnknown ? 1 : 0;
      if (told_as == Sighting::kUnknown) continue;
      EXPECT_EQ(told_as == Sighting::kSeen, was_truly_seen(entries, span))
          << "round " << round << " since " << since << " first frame " << span.frames.first;
    }
  }
  EXPECT_LT(num_unknown, num_asked / 2);
  EXPECT_GT(num_unknown, 0);
}

TEST(SeenIn, TwoSpansSeeWhatTheirUnionDoes) {
  std::mt19937 random(10);
  for (int round = 0; round < 200; ++round) {
    const Object object = object_with_log(random_history(random, 64, 64));
    const auto middle = static_cast<std::int64_t>(random() % 64);
    const auto end = middle + static_cast<std::int64_t>(random() % 20);
    const auto seen = [&](std::int64_t since, std::int64_t until) {
      return was_seen_in(object, {.since = stamp_s(since), .until = stamp_s(until)}) ==
             Sighting::kSeen;
    };
    EXPECT_EQ(seen(0, middle) || seen(middle + 1, end), seen(0, end));
  }
}

}  // namespace
}  // namespace hypermap
