// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/zone_masks.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

class ZoneRulesFile : public testing::Test {
 protected:
  Result<ZoneRules> read(const std::string& text) {
    std::ofstream(dir_ / "zones.yaml") << text;
    return read_zone_rules(dir_ / "zones.yaml");
  }

  test::TempDir dir_;
};

TEST_F(ZoneRulesFile, SaysHowFarRobotsKeepOffAndHowSlowTheyGo) {
  const auto rules = read(
      "robot_height_m: 0.5\n"
      "zones:\n  Potted Plant: {keepout_m: 0.2}\n"
      "  tv: {keepout_m: 0, speed_percent: 30, speed_radius_m: 2.5}\n");
  ASSERT_TRUE(rules) << to_string(rules.error());
  EXPECT_EQ(rules->robot_height_m, 0.5);
  EXPECT_EQ(rules->of_class.at("pottedplant"), (ZoneRule{.keepout_m = 0.2, .speed = {}}));
  EXPECT_EQ(rules->of_class.at("tvmonitor"),
            (ZoneRule{.keepout_m = 0.0, .speed = SpeedZone{.percent = 30, .radius_m = 2.5}}));
  EXPECT_TRUE(read("zones: {}\n")->of_class.empty());
}

TEST_F(ZoneRulesFile, WhatIsWrongIsNamed) {
  const auto field = [&](const std::string& text) { return read(text).error().field; };
  const auto unknown = read("zones:\n  cup: {keep_out_m: 1}\n").error();
  EXPECT_EQ(unknown.code, ErrorCode::kNotFound);
  EXPECT_EQ(unknown.line, 2);
  EXPECT_THAT(unknown.what, HasSubstr("did you mean \"keepout_m\""));
  EXPECT_EQ(field("zone: {}\n"), "zone");
  EXPECT_EQ(field("robot_height_m: 1\n"), "zones");
  EXPECT_EQ(field("robot_height_m: tall\nzones: {}\n"), "robot_height_m");
  EXPECT_EQ(field("zones: {cup: {keepout_m: -0.1}}\n"), "zones.cup.keepout_m");
  EXPECT_EQ(field("zones: {cup: {keepout_m: 101}}\n"), "zones.cup.keepout_m");
  EXPECT_EQ(field("zones: {cup: {keepout_m: .nan}}\n"), "zones.cup.keepout_m");
  EXPECT_EQ(field("zones: {cup: {speed_percent: 0, speed_radius_m: 1}}\n"),
            "zones.cup.speed_percent");
  EXPECT_EQ(field("zones: {cup: {speed_percent: 33.3, speed_radius_m: 1}}\n"),
            "zones.cup.speed_percent");
  EXPECT_EQ(field("zones: {cup: {speed_percent: 50, speed_radius_m: far}}\n"),
            "zones.cup.speed_radius_m");
  EXPECT_EQ(field("zones: {cup: {speed_percent: 50}}\n"), "zones.cup");
  EXPECT_EQ(field("zones: {cup: {}}\n"), "zones.cup");
  EXPECT_EQ(field("zones: {cup: 0.5}\n"), "zones.cup");
  EXPECT_EQ(field("zones: {tv: {keepout_m: 1}, tvmonitor: {keepout_m: 1}}\n"), "zones.tvmonitor");
  EXPECT_EQ(read("zones: [cup]\n").error().code, ErrorCode::kMalformedFile);
  EXPECT_EQ(read_zone_rules(dir_ / "absent.yaml").error().code, ErrorCode::kIo);
}

TEST_F(ZoneRulesFile, TheShippedRulesReachClassesByTheirKinds) {
  const auto rules = read_zone_rules(test::source_path("data/nav2.yaml"));
  ASSERT_TRUE(rules) << to_string(rules.error());
  const auto vocabulary = read_vocabulary(test::source_path("data/vocabulary.yaml")).value();
  const auto keepout = [&](const std::string& name) {
    const auto rule = zone_rule_of(name, *rules, vocabulary);
    return rule ? rule->keepout_m : std::nullopt;
  };
  EXPECT_EQ(keepout("person"), 0.5);
  EXPECT_EQ(keepout("pedestrian"), 0.5) << "an alias";
  EXPECT_EQ(keepout("settee"), 0.1) << "a couch, so a seat";
  EXPECT_EQ(keepout("bookcase"), 0.05) << "a bookshelf, so storage, so furniture";
  EXPECT_EQ(keepout("spoon"), std::nullopt);
  EXPECT_EQ(zone_rule_of("person", *rules, vocabulary)->speed->percent, 30);
}

TEST(ZoneRuleOf, TheNearestNameWins) {
  ZoneRules rules;
  const auto add = [&](const std::string& name, double keepout_m) {
    rules.of_class[name] = {.keepout_m = keepout_m, .speed = {}};
  };
  const auto vocabulary =
      ClassVocabulary::create(
          {.aliases = {{{"bin"}, {{"bucket"}, {"pail"}}}},
           .super_classes = {{{"container"}, {{"vessel"}}}, {{"vessel"}, {{"bin"}, {"jar"}}}}})
          .value();
  add("container", 1.0);
  EXPECT_EQ(zone_rule_of("Pail", rules, vocabulary)->keepout_m, 1.0);
  add("vessel", 2.0);
  EXPECT_EQ(zone_rule_of("Pail", rules, vocabulary)->keepout_m, 2.0);
  add("bucket", 3.0);
  EXPECT_EQ(zone_rule_of("Pail", rules, vocabulary)->keepout_m, 3.0) << "another alias";
  add("bin", 4.0);
  EXPECT_EQ(zone_rule_of("Pail", rules, vocabulary)->keepout_m, 4.0) << "its class";
  EXPECT_EQ(zone_rule_of("bucket", rules, vocabulary)->keepout_m, 3.0) << "its own";
  EXPECT_FALSE(zone_rule_of("table", rules, vocabulary));
  EXPECT_FALSE(zone_rule_of("jar", rules, {}).has_value()) << "no vocabulary, no kinds";
}

SemanticObject square_of(const std::string& name, double x, double y, double side) {
  SemanticObject object;
  object.name = name;
  object.parts = {
      make_polygon({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}).value()};
  return object;
}

// Cells of a metre in one row. The person fills the third: between middles 0.5 + 0.71 m reach the
// next one, 2.5 + 0.71 m the third from it. The cat in the first one says 80 %.
TEST(ZoneMasks, TheSlowestZoneCounts) {
  const GridGeometry grid{.resolution_m = 1.0, .cols = 7, .rows = 1};
  const ZoneRules rules{
      .of_class = {
          {"person", {.keepout_m = 0.5, .speed = SpeedZone{.percent = 30, .radius_m = 2.5}}},
          {"cat", {.keepout_m = {}, .speed = SpeedZone{.percent = 80, .radius_m = 9.0}}}}};
  const std::vector<SemanticObject> objects{square_of("Person", 2.0, 0.0, 1.0),
                                            square_of("cat", 0.0, 0.0, 1.0),
                                            square_of("unicorn", 6.0, 0.0, 1.0)};
  const auto masks = zone_masks(grid, objects, rules, {});
  ASSERT_TRUE(masks) << to_string(masks.error());
  EXPECT_THAT(masks->keepout.cells(), ElementsAre(0, 100, 100, 100, 0, 0, 0));
  EXPECT_THAT(masks->speed.cells(), ElementsAre(30, 30, 30, 30, 30, 30, 80));
}

TEST(ZoneMasks, WithoutRulesOrObjectsNothingIsClosed) {
  const GridGeometry grid{.resolution_m = 1.0, .cols = 3, .rows = 2};
  const ZoneRules rules{.of_class = {{"cup", {.keepout_m = 1.0, .speed = {}}}}};
  EXPECT_THAT(zone_masks(grid, {}, rules, {})->keepout.cells(), Each(0));
  const std::vector<SemanticObject> objects{square_of("cup", 0.0, 0.0, 1.0)};
  EXPECT_THAT(zone_masks(grid, objects, {}, {})->keepout.cells(), Each(0));
  EXPECT_THAT(zone_masks(grid, objects, rules, {})->speed.cells(), Each(0));
}

/// From the middle of a cell to the nearest point of any object, in metres.
double way_to(const std::vector<SemanticObject>& objects, const Eigen::Vector2d& middle) {
  double nearest = 1e9;
  for (const SemanticObject& object : objects) {
    nearest = std::min(nearest, distance_m(object.parts.front(), middle));
  }
  return nearest;
}

TEST(ZoneMasks, AZoneIsAsLargeAsItsDistanceToOneCell) {
  for (int seed = 0; seed < test::repetitions(10); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 3);
    const GridGeometry grid{.resolution_m = 0.25, .origin = {-2.0, 1.0}, .cols = 40, .rows = 30};
    std::vector<SemanticObject> objects;
    objects.reserve(3);
    for (int i = 0; i < 3; ++i) {
      objects.push_back(square_of(
          "chair", rng.uniform(-4.0, 8.0), rng.uniform(-1.0, 9.0), rng.uniform(0.2, 2.0)));
    }
    const double keepout_m = rng.uniform(0.0, 1.5);
    const ZoneRules rules{.of_class = {{"chair", {.keepout_m = keepout_m, .speed = {}}}}};
    const auto masks = zone_masks(grid, objects, rules, {}).value();
    for (int row = 0; row < grid.rows; ++row) {
      for (int col = 0; col < grid.cols; ++col) {
        const double way_m = way_to(objects, centre(grid, {col, row}));
        const bool is_closed = masks.keepout.at({col, row}) == kOccupiedCell;
        if (way_m <= keepout_m) {
          ASSERT_TRUE(is_closed) << seed << ": " << col << ", " << row;
        }
        if (is_closed) {
          ASSERT_LE(way_m, keepout_m + 0.25 * std::sqrt(2.0)) << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hypermap
