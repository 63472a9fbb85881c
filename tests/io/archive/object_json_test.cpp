// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;

const SourceName kObjectsSource{.file = "a.hmap", .entry = "objects.jsonl"};

Polygon square(double x, double y, double edge) {
  return {.outer = {{x, y}, {x + edge, y}, {x + edge, y + edge}, {x, y + edge}}, .holes = {}};
}

BeliefChanges changes_of_two_classes() {
  const std::vector<BeliefChange> changes{{ClassId{7}, -0.413F}, {ClassId{0}, 0.1F}};
  return BeliefChanges::from_entries(changes).value();
}

/// An object in which every part holds numbers that no short decimal gives.
Object random_object(std::mt19937& engine) {
  std::uniform_real_distribution<double> real(-3.0, 3.0);
  Object object;
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{2}, Probability(0.6180339887498949)},
                                                   {ClassId{7}, Probability(1.0 / 3.0)}},
                        Probability(1.0 / 80.0));
  object.existence = LogOdds(real(engine));
  object.box_confidence = LogOdds(real(engine));
  object.box.min_in_map = {real(engine), real(engine), real(engine)};
  object.box.max_in_map = object.box.min_in_map + Eigen::Vector3d(0.1, 1.0 / 3.0, 5e-324);
  object.centroid_in_map = {-0.0, real(engine), real(engine)};
  object.histogram.observe(real(engine), 1.5);
  object.shapes.add(square(real(engine), real(engine), 0.7));
  object.shapes.add(square(real(engine), real(engine), 0.3));
  object.points.observe(std::vector<Eigen::Vector3f>{{1.0F, 2.0F, 0.5F}, {-1.0F, 0.1F, 0.2F}});
  for (std::uint64_t i = 0; i < 5; ++i)
    object.observation_log.add(
        {.frame_index = i + (std::uint64_t{1} << 40),
         .stamp = {static_cast<std::int64_t>(1400000000123456789 + i)},
         .kind = i % 2 == 0 ? ObservationKind::kDetection : ObservationKind::kMissedDetection,
         .visibility = Visibility::kPartlyOccluded,
         .detector = DetectorId{1},
         .class_id = ClassId{2},
         .score = 0.1F,
         .bearing_rad = static_cast<float>(real(engine)),
         .distance_m = 2.7182817F,
         .effect = -0.3F,
         .belief_change = 1.25F,
         .other_changes = i % 2 == 0 ? changes_of_two_classes() : BeliefChanges{}});
  object.first_seen = {1400000000123456789};
  object.last_seen = {-5};
  object.num_observations = 4000000000U;
  object.farthest_detection_m = real(engine) + 4.0;
  return object;
}

ObjectMap sample(int num_objects) {
  std::mt19937 engine(5);
  ObjectMap map;
  for (int i = 0; i < num_objects; ++i) map.add(random_object(engine));
  if (num_objects > 2) map.erase(ObjectId{2});
  return map;
}

std::string objects_error(const std::string& text, const ObjectFileLimits& limits = {}) {
  const auto objects = parse_objects(text, kObjectsSource, limits);
  return objects ? "no error" : to_string(objects.error());
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(ObjectJson, EveryBitOfEveryObjectSurvives) {
  for (const int num_objects : {0, 1, 20}) {
    const ObjectMap objects = sample(num_objects);
    const std::string text = write_objects(objects).value();
    const auto again = parse_objects(text, kObjectsSource);
    ASSERT_TRUE(again) << to_string(again.error());
    EXPECT_TRUE(*again == objects);
    EXPECT_EQ(write_objects(*again).value(), text);
  }
}

TEST(ObjectJson, APriorSurvivesAndIsChecked) {
  Object object;
  object.box.max_in_map = {1, 1, 1};
  ObjectMap objects;
  objects.add(object);
  EXPECT_THAT(write_objects(objects).value(), testing::Not(HasSubstr("prior")));
  object.prior =
      ClassPrior::create({{ClassId{2}, LogOdds(-1.0 / 3.0)}, {ClassId{7}, LogOdds(0.5)}}).value();
  objects.add(object);
  const std::string text = write_objects(objects).value();
  EXPECT_THAT(text, HasSubstr(",\"prior\":[[2,-0.3333333333333333],[7,0.5]]}"));
  EXPECT_EQ(parse_objects(text, kObjectsSource).value(), objects);
  std::string wrong = text;
  wrong.replace(wrong.find("[7,0.5]"), 7, "[1,0.5]");
  EXPECT_THAT(to_string(parse_objects(wrong, kObjectsSource).error()), HasSubstr("prior"));
}

TEST(ObjectJson, LooksAtBlocksSurviveAndAreChecked) {
  const std::vector<Eigen::Vector3f> left{{0.0F, 0.1F, 0.1F}};
  const std::vector<Eigen::Vector3f> right{{0.1F, 0.1F, 0.1F}};
  Object object;
  object.box.max_in_map = {1, 1, 1};
  for (const auto& seen : {left, right}) {
    object.points.observe(seen);
    object.points.look(
        seen, [](const Eigen::Vector3d&) { return false; }, 0);
  }
  ObjectMap objects;
  objects.add(object);
  const std::string text = write_objects(objects).value();
  EXPECT_THAT(text, HasSubstr("\"looks\":{\"origin\":[0,2,2],"));
  EXPECT_EQ(parse_objects(text, kObjectsSource).value(), objects);
  EXPECT_THAT(objects_error(with_replaced(text, "\"looks\":{", "\"looks\":{\"x\":1,")),
              HasSubstr("points.looks.x"));
  EXPECT_THAT(objects_error(with_replaced(
                  text, "\"num_observations\":2,\"origin", "\"num_observations\":1,\"origin")),
              HasSubstr("points.looks[0]"));
  const std::size_t at = text.find("\"cells\":\"") + 9;
  EXPECT_THAT(objects_error(text.substr(0, at) + "?" + text.substr(at + 1)),
              HasSubstr("points.looks.cells"));
}

/// What an older version wrote of one object: its cells among its state, no line of their own.
std::string older_version(const std::string& text, int version, const std::string& cells) {
  std::string older =
      with_replaced(text, "\"version\":4", "\"version\":" + std::to_string(version));
  older.resize(older.rfind('\n', older.size() - 2) + 1);
  const std::size_t from = older.find("\"origin\":");
  const std::size_t to = older.find("},\"ledger\"");
  return older.replace(from, to - from, cells);
}

TEST(ObjectJson, VersionOneListsCellsAndVotesAsNumbers) {
  const ObjectMap objects = sample(1);
  std::string votes = "\"votes\":[";
  for (const PointVote& vote : objects.at(ObjectId{1}).points.state().votes) {
    votes += (votes.back() == '[' ? "[" : ",[") + std::to_string(vote.cell.x) + "," +
             std::to_string(vote.cell.y) + "," + std::to_string(vote.cell.z) + "," +
             std::to_string(vote.votes) + "]";
  }
  const auto again =
      parse_objects(older_version(write_objects(objects).value(), 1, votes + "]"), kObjectsSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_TRUE(*again == objects);
}

TEST(ObjectJson, VersionTwoHasCellsAsTwoTextsOfTheObject) {
  Object object;
  object.box.max_in_map = {1, 1, 1};
  const std::vector<Eigen::Vector3f> points{{0.005F, 0.005F, 0.005F}, {0.015F, 0.005F, 0.005F}};
  object.points.observe(points);
  ObjectMap objects;
  objects.add(object);
  // Two cells side by side in x, an observation each.
  const std::string cells = R"("origin":[0,0,0],"levels":1,"cells":"11","votes":"BB")";
  const auto again =
      parse_objects(older_version(write_objects(objects).value(), 2, cells), kObjectsSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_TRUE(*again == objects);
}

TEST(ObjectJson, DamagedCellsAreNamed) {
  const std::string text = write_objects(sample(1)).value();
  const std::size_t cells = text.rfind('\n', text.size() - 2) + 1;
  std::string longer = text;
  longer.insert(cells + 1, "AAAA");
  EXPECT_THAT(objects_error(longer), HasSubstr("a.hmap!objects.jsonl:3: $: its bytes"));
  std::string no_letters = text;
  no_letters.replace(cells + 1, 1, "-");
  EXPECT_THAT(objects_error(no_letters), HasSubstr("a.hmap!objects.jsonl:3: $: base64 must be"));
  std::string no_text = text;
  no_text.replace(cells, std::string::npos, "7\n");
  EXPECT_THAT(objects_error(no_text), HasSubstr("a.hmap!objects.jsonl:3"));
  EXPECT_THAT(objects_error(text.substr(0, cells)), HasSubstr("only 0 lines of cells"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"levels\":", "\"levels\":9")),
              HasSubstr("$.points.levels: must be in 0 .. 32"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"num_cells\":", "\"num_cells\":99999")),
              HasSubstr("$.points.num_cells: are more cells than max_cells"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"origin\":[", "\"origin\":[1,")),
              HasSubstr("$.points.origin"));
}

TEST(ObjectJson, ManyObjectsKeepTheirOrderAndTheFirstErrorIsTheOneNamed) {
  ObjectMap objects;
  for (int i = 0; i < 1200; ++i) {
    Object object;
    object.box.max_in_map = {1.0 + i, 1, 1};
    const std::vector<Eigen::Vector3f> points{{0.1F * static_cast<float>(i), 0.0F, 0.0F}};
    object.points.observe(points);
    objects.add(object);
  }
  std::string text = write_objects(objects).value();
  EXPECT_EQ(text, write_objects(objects).value());
  EXPECT_TRUE(parse_objects(text, kObjectsSource).value() == objects);
  for (const char* id : {"\"id\":900,", "\"id\":700,", "\"id\":1100,"}) {
    text = with_replaced(text, id, "\"id\":0,");
  }
  EXPECT_THAT(objects_error(with_replaced(text, "\"id\":600,", "\"id\":\"x\",")),
              HasSubstr("objects.jsonl:601: $.id"));
}

TEST(ObjectJson, TheNextIdSurvivesErasing) {
  const auto again = parse_objects(write_objects(sample(3)).value(), kObjectsSource);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->size(), 2U);
  EXPECT_EQ(again->next_id(), ObjectId{4});
}

TEST(ObjectJson, NumbersThatAreNotFiniteAreRefusedAtTheSave) {
  ObjectMap objects = sample(1);
  objects.modify(ObjectId{1}, [](Object& object) {
    object.existence = LogOdds(std::numeric_limits<double>::infinity());
  });
  const auto text = write_objects(objects);
  ASSERT_FALSE(text);
  EXPECT_THAT(to_string(text.error()), HasSubstr("object 1"));
}

TEST(ObjectJson, ErrorsNameMemberLineAndPath) {
  const std::string text = write_objects(sample(1)).value();
  const std::string error =
      objects_error(with_replaced(text, "\"existence\":", "\"existence\":\"x\",\"y\":"));
  EXPECT_THAT(error, HasSubstr("a.hmap!objects.jsonl:2"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"existence\":", "\"existance\":")),
              HasSubstr("existence"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"bins\":[", "\"bins\":[null,")),
              HasSubstr("bins[0]"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"id\":1,", "\"id\":1,\"color\":2,")),
              HasSubstr("unknown key"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"id\":1,", "\"id\":0,")), HasSubstr("a.hmap"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"version\":4", "\"version\":7")),
              HasSubstr("written by a newer version 7"));
}

TEST(ObjectJson, TheNumberOfLinesMustBeTheOneSaid) {
  const std::string text = write_objects(sample(1)).value();
  EXPECT_THAT(objects_error(with_replaced(text, "\"num_objects\":1", "\"num_objects\":2")),
              HasSubstr("says 2 objects"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"num_objects\":1", "\"num_objects\":0")),
              HasSubstr("there are more"));
  EXPECT_THAT(objects_error(text, {.max_objects = 0}), HasSubstr("the limit is 0"));
}

TEST(ObjectJson, ACutAnywhereIsAnError) {
  const std::string text = write_objects(sample(1)).value();
  for (std::size_t length = 0; length < text.size(); ++length)
    ASSERT_FALSE(parse_objects(text.substr(0, length), kObjectsSource)) << length;
}

TEST(ObjectJson, PolygonsFarAwayOrWithoutAreaOfPointsAreErrors) {
  const std::string text = write_objects(sample(1)).value();
  EXPECT_THAT(objects_error(with_replaced(text, "\"hull\":[[[", "\"hull\":[[[1e7,0],[")),
              HasSubstr("beyond 1e6"));
  EXPECT_THAT(objects_error(with_replaced(text, "\"kept\":[", "\"kept\":[[[[0,0],[1,1]]],")),
              HasSubstr("ring of 2 points"));
  EXPECT_THAT(objects_error(text, {.max_vertices = 3}), HasSubstr("expected 3 to 3"));
}

}  // namespace
}  // namespace hypermap
