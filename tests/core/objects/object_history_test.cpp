// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_history.hpp"

#include "history_logs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;
using namespace testing_support;  // NOLINT(google-build-using-namespace): logs in words

TEST(ObjectHistory, BySecondThreeItHadBeenSeenTwiceAndNeverMissed) {
  const Object object =
      object_with_log({detected_at(1), detected_at(3), absent_at(5), detected_at(9)});
  const auto past = log_as_of(object.observation_log, moment_s(4));
  ASSERT_TRUE(past);
  EXPECT_TRUE(past->is_whole);
  EXPECT_THAT(past->log.state().newest, ElementsAre(detected_at(1), detected_at(3)));
  EXPECT_EQ(past->log.num_detections(), 2U);
  EXPECT_EQ(detection_regularity(past->log).missed_visibility, 0.0);
  EXPECT_FALSE(log_as_of(object.observation_log, moment_s(0)));
}

TEST(ObjectHistory, TheStampItselfBelongsToThePast) {
  const Object object = object_with_log({detected_at(1), detected_at(3)});
  EXPECT_EQ(log_as_of(object.observation_log, moment_s(1))->log.num_detections(), 1U);
  EXPECT_EQ(log_as_of(object.observation_log, moment_s(3))->log, object.observation_log);
}

TEST(ObjectHistory, WhatIsBelievedOfAnObjectGoesBackWithItsLog) {
  ObjectMap map;
  const ObjectId id =
      map.add(object_with_log({detected_at(1), detected_at(3), absent_at(5), detected_at(9)}));
  const PastObjects past = objects_as_of(map, moment_s(6));
  ASSERT_TRUE(past.objects.contains(id));
  EXPECT_TRUE(past.unknown.empty());
  const Object& then = past.objects.at(id);
  EXPECT_EQ(then.num_observations, 2U);
  EXPECT_EQ(then.last_seen, stamp_s(3));
  EXPECT_DOUBLE_EQ(then.existence.value(), 0.25 + 0.25 - 1.0);
  EXPECT_EQ(absence_run(then.observation_log).looks, 1U);
  EXPECT_EQ(map.at(id).num_observations, 3U) << "the map itself stays";
}

TEST(ObjectHistory, AClassThatWasNamedLaterIsNotBelievedYet) {
  ObservationLogEntry later = detected_at(5);
  later.class_id = ClassId{2};
  Object object = object_with_log({detected_at(1), detected_at(2), later});
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{2}, Probability(0.9)}},
                        Probability(0.5));
  ObjectMap map;
  const ObjectId id = map.add(std::move(object));
  const Object then = objects_as_of(map, moment_s(4)).objects.at(id);
  const auto classes = class_distribution(then);
  ASSERT_EQ(classes.size(), 1U);
  EXPECT_EQ(classes.front().id, ClassId{1});
  EXPECT_EQ(class_distribution(map.at(id)).size(), 2U);
}

TEST(ObjectHistory, OfALongLogTheMomentBeforeTheOldestKeptEntryIsNotKnown) {
  ObjectMap map;
  const ObjectId id = map.add(object_with_log(every_second(100)));  // keeps 0 and 36 .. 99
  EXPECT_THAT(kept_since(map.at(id).observation_log), Optional(stamp_s(36)));
  const PastObjects lost = objects_as_of(map, moment_s(35));
  EXPECT_TRUE(lost.objects.empty());
  EXPECT_EQ(lost.unknown.at(id), map.at(id));
  const PastObjects kept = objects_as_of(map, moment_s(36));
  EXPECT_TRUE(kept.unknown.empty());
  EXPECT_EQ(kept.objects.at(id).num_observations, 37U);
  EXPECT_EQ(kept.objects.at(id).observation_log.num_detections(), 37U);
  EXPECT_TRUE(objects_as_of(map, moment_s(-1)).unknown.empty()) << "not seen yet";
}

TEST(ObjectHistory, SixtyFiveEntriesAreAllKept) {
  const Object object = object_with_log(every_second(65));
  EXPECT_THAT(kept_since(object.observation_log), Optional(stamp_s(0)));
  for (std::int64_t second = 0; second < 65; ++second) {
    const auto past = log_as_of(object.observation_log, moment_s(second));
    ASSERT_TRUE(past && past->is_whole) << second;
    EXPECT_EQ(past->log, object_with_log(every_second(second + 1)).observation_log) << second;
  }
}

TEST(ObjectHistory, LooksThatMayHaveBegunEarlierAreNotKnown) {
  std::vector<ObservationLogEntry> entries = every_second(20);
  for (std::int64_t second = 20; second < 120; ++second) entries.push_back(absent_at(second));
  const Object object = object_with_log(entries);
  const auto past = log_as_of(object.observation_log, moment_s(60));  // kept: 56 .. 119
  ASSERT_TRUE(past);
  EXPECT_FALSE(past->is_whole) << "five looks are kept, forty there were";
}

TEST(ObjectHistory, TheLastDetectionIsToldWhereItIsKept) {
  std::vector<ObservationLogEntry> entries = every_second(20);
  EXPECT_THAT(last_detection(object_with_log(entries).observation_log), Optional(stamp_s(19)));
  for (std::int64_t second = 20; second < 120; ++second) entries.push_back(absent_at(second));
  EXPECT_EQ(last_detection(object_with_log(entries).observation_log), std::nullopt);
  EXPECT_EQ(last_detection({}), std::nullopt);
  std::vector<ObservationLogEntry> once{detected_at(0)};
  for (std::int64_t second = 1; second < 100; ++second) once.push_back(absent_at(second));
  EXPECT_THAT(last_detection(object_with_log(once).observation_log), Optional(stamp_s(0)));
}

TEST(ObjectHistory, AMomentOfASessionHasAllFramesOfThoseBefore) {
  // Two sessions of ten frames whose clocks both begin at 0.
  const Object object = object_with_log(
      {detected_in(2, 2), detected_in(8, 8), detected_in(11, 1), detected_in(15, 5)});
  const MapMoment in_second{.stamp = stamp_s(3), .frames = {.first = 10, .end = 20}};
  const auto past = log_as_of(object.observation_log, in_second);
  ASSERT_TRUE(past && past->is_whole);
  EXPECT_THAT(past->log.state().newest,
              ElementsAre(detected_in(2, 2), detected_in(8, 8), detected_in(11, 1)));
  const MapMoment in_first{.stamp = stamp_s(5), .frames = {.first = 0, .end = 10}};
  EXPECT_EQ(log_as_of(object.observation_log, in_first)->log.num_detections(), 1U);
  EXPECT_FALSE(log_as_of(object.observation_log, moment_s(3))->is_whole)
      << "by stamps alone the second session would come into the first";
}

TEST(ObjectHistory, AnObjectWithoutALogIsKnownByItsFirstSightAlone) {
  Object object;
  object.box = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  object.first_seen = object.last_seen = stamp_s(5);
  object.num_observations = 1;
  ObjectMap map;
  const ObjectId id = map.add(object);
  EXPECT_TRUE(objects_as_of(map, moment_s(5)).unknown.contains(id));
  const PastObjects before = objects_as_of(map, moment_s(4));
  EXPECT_TRUE(before.objects.empty() && before.unknown.empty());
  EXPECT_EQ(was_seen_in(map.at(id), {.since = stamp_s(5)}), Sighting::kSeen);
  EXPECT_EQ(was_seen_in(map.at(id), {.since = stamp_s(6)}), Sighting::kNotSeen);
}

TEST(SeenIn, AShortLogTellsEachSpan) {
  const Object object = object_with_log({detected_at(1), absent_at(4), detected_at(9)});
  const auto seen = [&](std::int64_t since, std::int64_t until) {
    return was_seen_in(object, {.since = stamp_s(since), .until = stamp_s(until)});
  };
  EXPECT_EQ(seen(0, 1), Sighting::kSeen) << "the end belongs to it";
  EXPECT_EQ(seen(2, 8), Sighting::kNotSeen) << "looked for, not seen";
  EXPECT_EQ(seen(9, 20), Sighting::kSeen);
  EXPECT_EQ(seen(10, 20), Sighting::kNotSeen);
  EXPECT_EQ(was_seen_in(object, {.until = stamp_s(0)}), Sighting::kNotSeen);
  EXPECT_EQ(was_seen_in(object, {}), Sighting::kSeen);
}

TEST(SeenIn, WhatALongLogLostIsUnknownOnlyWhereItMayBe) {
  std::vector<ObservationLogEntry> entries{detected_at(0), detected_at(10)};
  for (std::int64_t second = 40; second < 140; ++second) entries.push_back(detected_at(second));
  const Object object = object_with_log(entries);  // keeps 0 and 76 .. 139
  const auto seen = [&](std::int64_t since, std::int64_t until) {
    return was_seen_in(object, {.since = stamp_s(since), .until = stamp_s(until)});
  };
  EXPECT_EQ(seen(5, 20), Sighting::kUnknown);
  EXPECT_EQ(seen(0, 3), Sighting::kSeen);
  EXPECT_EQ(seen(60, 80), Sighting::kSeen);
  EXPECT_EQ(seen(150, 160), Sighting::kNotSeen);
}

TEST(ObjectHistory, MergedLogsAreReplayedAsOne) {
  const Object a = object_with_log({detected_at(1), detected_at(5)});
  const Object b = object_with_log({detected_at(3), detected_at(7)});
  const Object both = merged(a, b, LogOdds(10.0));
  const auto past = log_as_of(both.observation_log, moment_s(4));
  ASSERT_TRUE(past && past->is_whole);
  EXPECT_THAT(past->log.state().newest, ElementsAre(detected_at(1), detected_at(3)));
}

}  // namespace
}  // namespace hypermap
