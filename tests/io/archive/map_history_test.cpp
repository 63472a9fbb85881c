// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_history.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "io/archive/two_sessions.hpp"
#include "support/object_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::history_stamp;
using test::two_sessions;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A detection, or a clear look through the place, in the frame of that number, a second each.
ObservationLogEntry history_entry(std::uint64_t frame, std::int64_t second, bool is_detection) {
  return {.frame_index = frame,
          .stamp = history_stamp(second),
          .kind = is_detection ? ObservationKind::kDetection : ObservationKind::kMissedDetection,
          .visibility = is_detection ? Visibility::kVisible : Visibility::kAbsent,
          .class_id = ClassId{0},
          .score = is_detection ? 0.9F : 0.0F,
          // From one side after the other, as a robot goes round it.
          .bearing_rad = static_cast<float>(frame % 6),
          .distance_m = 2.0F,
          .effect = is_detection ? 0.5F : -1.0F};
}

struct History {
  std::int64_t since = 0;  ///< Detected each second of [since, until] ...
  std::int64_t until = 0;
  std::int64_t missed_until = 0;  ///< ... and then missed, the place being looked through.
};

/// A chair at x whose history that is. Frames are numbered by their seconds.
Object chair_of(double x, const History& history) {
  using testing_support::box_at;
  Object object;
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{0}, Probability(0.9)}},
                        Probability(0.5));
  object.box = box_at({x, 0.0, 0.5}, {0.5, 0.5, 1.0});
  object.centroid_in_map = object.box.centre();
  object.points.observe(testing_support::surface_of(object.box, 0.05));
  object.first_seen = history_stamp(history.since);
  object.last_seen = history_stamp(history.until);
  for (std::int64_t second = history.since; second <= history.until; ++second) {
    object.observation_log.add(history_entry(static_cast<std::uint64_t>(second), second, true));
    ++object.num_observations;
  }
  for (std::int64_t second = history.until + 1; second <= history.missed_until; ++second) {
    object.observation_log.add(history_entry(static_cast<std::uint64_t>(second), second, false));
  }
  return object;
}

/// A chair of each history, 2 m apart, shown where the rules confirm it now.
MapArchive archive_of_chairs(std::initializer_list<History> histories) {
  MapArchive archive;
  EXPECT_EQ(archive.classes.add("chair").value(), ClassId{0});
  double x = 0.0;
  for (const History& history : histories) {
    archive.objects.add(chair_of(x, history));
    x += 2.0;
  }
  std::vector<SemanticObject> shapes;
  for (const ObjectId id : confirmed_objects(archive.objects, {})) {
    const Box& box = archive.objects.at(id).box;
    const double left = box.min_in_map.x();
    shapes.push_back({.id = id.value,
                      .name = "chair",
                      .parts = {make_polygon({{left, 0}, {left + 0.4, 0}, {left, 0.3}}).value()},
                      .confidence = {0.5}});
  }
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic"}, .content = SemanticLayer::create(shapes).value()}));
  return archive;
}

std::vector<std::uint64_t> history_ids(const MapArchive& archive,
                                       const std::string& layer = "objects") {
  const auto answers = query_map(archive, {.layer = layer, .text = "chair"});
  EXPECT_TRUE(answers) << to_string(answers.error());
  std::vector<std::uint64_t> ids;
  if (!answers) return ids;
  for (const MapAnswer& one : answers->found) ids.push_back(one.id);
  return ids;
}

/// One chair stays; one is gone from second 21 on; one comes at second 30.
MapArchive moved_chairs() {
  return archive_of_chairs({{.since = 0, .until = 40},
                            {.since = 5, .until = 20, .missed_until = 40},
                            {.since = 30, .until = 40}});
}

TEST(MapAsOf, AChairIsThereUntilItIsGone) {
  const MapArchive archive = moved_chairs();
  EXPECT_THAT(history_ids(archive), ElementsAre(1, 3));
  const PastMap then = map_as_of(archive, history_stamp(20)).value();
  EXPECT_THAT(history_ids(then.map), ElementsAre(1, 2));
  EXPECT_THAT(history_ids(then.map, "semantic"), ElementsAre(1, 2));
  EXPECT_TRUE(then.unknown.objects.empty());
  EXPECT_FALSE(then.has_classes_of_now);
  // The third look through its place after second 20 is no five yet.
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(23)).value().map), ElementsAre(1, 2));
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(25)).value().map), ElementsAre(1));
}

TEST(MapAsOf, EachSecondIsTheMapThatEndedThen) {
  const MapArchive archive = moved_chairs();
  for (std::int64_t second = 0; second <= 40; ++second) {
    const auto up_to = [&](const History& whole) {
      History part = whole;
      part.until = std::min(part.until, second);
      part.missed_until = std::min(part.missed_until, second);
      return part;
    };
    ObjectMap ended;
    double x = 0.0;
    for (const History& whole : {History{.since = 0, .until = 40},
                                 History{.since = 5, .until = 20, .missed_until = 40},
                                 History{.since = 30, .until = 40}}) {
      if (whole.since <= second) ended.add(chair_of(x, up_to(whole)));
      x += 2.0;
    }
    const PastMap then = map_as_of(archive, history_stamp(second)).value();
    std::vector<std::uint64_t> expected;
    for (const ObjectId id : confirmed_objects(ended, {})) expected.push_back(id.value);
    EXPECT_EQ(history_ids(then.map), expected) << second;
    for (const Object& object : ended.objects()) {
      EXPECT_EQ(then.map.objects.at(object.id).observation_log, object.observation_log) << second;
      EXPECT_EQ(real_probability(then.map.objects.at(object.id)), real_probability(object));
    }
  }
}

TEST(MapAsOf, TheLastFrameGivesTheMap) {
  const MapArchive archive = moved_chairs();
  const PastMap then = map_as_of(archive, history_stamp(40)).value();
  EXPECT_EQ(then.map.objects, archive.objects);
  EXPECT_EQ(history_ids(then.map), history_ids(archive));
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(-1)).value().map), IsEmpty());
}

TEST(MapAsOf, ShapesAreThoseOfNowAndConfidencesThoseOfThen) {
  const MapArchive archive = moved_chairs();
  const PastMap then = map_as_of(archive, history_stamp(20)).value();
  const auto* shapes = then.map.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  const auto* now = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  EXPECT_EQ(shapes->find(1)->parts, now->find(1)->parts);
  ASSERT_EQ(now->find(2), nullptr);
  EXPECT_NEAR(bounds_of(*shapes->find(2)).max.x() - bounds_of(*shapes->find(2)).min.x(), 0.5, 0.1)
      << "of its points";
  EXPECT_DOUBLE_EQ(shapes->find(1)->confidence.front(),
                   object_confidence(then.map.objects.at(ObjectId{1})).value());
  EXPECT_EQ(then.map.octree, std::nullopt);
}

TEST(MapAsOf, WhatALogSumsUpIsSaidAndNotGuessed) {
  const MapArchive archive =
      archive_of_chairs({{.since = 0, .until = 150}, {.since = 0, .until = 30}});
  const PastMap then = map_as_of(archive, history_stamp(60)).value();
  EXPECT_THAT(history_ids(then.map), ElementsAre(2));
  EXPECT_THAT(history_ids(then.unknown), ElementsAre(1));
  EXPECT_THAT(history_ids(then.unknown, "semantic"), ElementsAre(1));
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(100)).value().map), ElementsAre(1, 2));
}

TEST(MapAsOf, AnObjectThatOnlyAnUnknownOneHidesIsUnknownToo) {
  MapArchive archive = archive_of_chairs({{.since = 0, .until = 150}});
  const ObjectId duplicate = archive.objects.add(chair_of(0.0, {.since = 1, .until = 30}));
  ASSERT_THAT(confirmed_objects(archive.objects, {}), ElementsAre(ObjectId{1}));
  const PastMap then = map_as_of(archive, history_stamp(60)).value();
  EXPECT_THAT(history_ids(then.map), IsEmpty());
  EXPECT_THAT(history_ids(then.unknown), ElementsAre(1, duplicate.value));
}

TEST(MapAsOf, RulesThatSumUpOtherwiseAreSaid) {
  const MapArchive archive = moved_chairs();
  const ConfirmationOptions weighted{.confidence = {.rule = ConfidenceRule::kWeighted}};
  EXPECT_TRUE(map_as_of(archive, history_stamp(20), {}, weighted).value().has_classes_of_now);
}

TEST(MapAsOf, AMapWithoutObjectsHasNoPast) {
  const auto refused = map_as_of(MapArchive{}, history_stamp(1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_FALSE(map_seen_in(MapArchive{}, {}));
}

TEST(MapSeenIn, WhatIsShownNowAndWasDetectedThen) {
  const MapArchive archive = moved_chairs();
  const auto seen = [&](std::int64_t since, std::int64_t until) {
    return map_seen_in(archive, {.since = history_stamp(since), .until = history_stamp(until)})
        .value();
  };
  EXPECT_THAT(history_ids(seen(0, 10).map), ElementsAre(1));
  EXPECT_EQ(seen(0, 10).num_unconfirmed, 1U) << "the chair that is gone";
  EXPECT_THAT(history_ids(seen(35, 50).map, "semantic"), ElementsAre(1, 3));
  EXPECT_THAT(history_ids(seen(41, 50).map), IsEmpty());
  EXPECT_THAT(history_ids(map_seen_in(archive, {}).value().map), ElementsAre(1, 3));
  const PastMap early = seen(0, 10);
  const auto* shapes = early.map.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  EXPECT_EQ(*shapes->find(1), *archive.hypermap.find_as<SemanticLayer>(kSemanticLayer)->find(1));
}

TEST(MapSeenIn, AMapWithoutALayerOfShapesShowsAllThatItSaw) {
  MapArchive archive = moved_chairs();
  archive.hypermap.remove_layer(kSemanticLayer);
  EXPECT_THAT(history_ids(map_seen_in(archive, {.since = history_stamp(41)}).value().map),
              IsEmpty());
  EXPECT_THAT(history_ids(map_seen_in(archive, {.until = history_stamp(10)}).value().map),
              ElementsAre(1, 2));
}

TEST(MapSeenIn, ASpanThatEndsBeforeItBeginsIsRefused) {
  const auto refused = map_seen_in(moved_chairs(), {.since = history_stamp(3), .until = Stamp{}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "since");
  EXPECT_THAT(to_string(refused.error()), HasSubstr("3.0 s"));
}

TEST(MapHistory, SessionsOfAnOlderMapHaveNoFramesOfTheirOwn) {
  auto runs = two_sessions(30);
  runs[0].next_frame_index = 0;
  MapArchive archive = moved_chairs();
  archive.provenance = runs;
  const auto refused = map_seen_in(archive, {.session = "morning"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("which frames are of session morning"));
}

TEST(MapSeenIn, EachSessionSawItsOwn) {
  MapArchive archive = moved_chairs();  // the third chair comes in frame 30
  archive.provenance = two_sessions(30);
  EXPECT_THAT(history_ids(map_seen_in(archive, {.session = "morning"}).value().map),
              ElementsAre(1));
  EXPECT_THAT(history_ids(map_seen_in(archive, {.session = "2"}).value().map), ElementsAre(1, 3));
  EXPECT_EQ(times_of(archive), (MapTimes{history_stamp(0), history_stamp(59)}));
}

TEST(MapAsOf, SessionsWhoseClocksOverlapHaveToBeNamed) {
  MapArchive archive = moved_chairs();
  archive.provenance = two_sessions(10);
  EXPECT_FALSE(follow_each_other(sessions_of(archive.provenance)));
  const auto refused = map_as_of(archive, history_stamp(20));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "session");
  EXPECT_THAT(to_string(refused.error()), HasSubstr("morning (0.0 .. 29.0 s)"));
  // Frames of the first session up to second 20: the second chair was there.
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(20), "morning").value().map),
              ElementsAre(1, 2));
  // All of the first, and the second up to second 40 of these stamps: it is gone.
  EXPECT_THAT(history_ids(map_as_of(archive, history_stamp(40), "2").value().map),
              ElementsAre(1, 3));
  EXPECT_TRUE(map_seen_in(archive, {.since = history_stamp(3)})) << "a span needs no session";
}

TEST(MapTimes, WithoutRunsTheObjectsTellThem) {
  EXPECT_EQ(times_of(moved_chairs()), (MapTimes{history_stamp(0), history_stamp(40)}));
  EXPECT_EQ(times_of(MapArchive{}), std::nullopt);
}

}  // namespace
}  // namespace hypermap
