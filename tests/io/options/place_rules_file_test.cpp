// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/place_rules_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PlaceRulesFile : public testing::Test {
 protected:
  Result<PlaceRules> read(const std::string& text) {
    std::ofstream(dir_ / "places.yaml") << text;
    return read_place_rules(dir_ / "places.yaml");
  }

  test::TempDir dir_;
};

TEST_F(PlaceRulesFile, NamesWhatBelongsWhere) {
  const auto rules = read(
      "belongings:\n  Dining Table: {kitchen: 4, hall: 0.5}\n  tv: {hall: 2}\nmetre_costs: {attic: "
      "3}\n"
      "tempering: 0.25\nmin_probability: 0.75\n");
  ASSERT_TRUE(rules) << to_string(rules.error());
  EXPECT_THAT(rules->places, ElementsAre("attic", "hall", "kitchen"));
  EXPECT_EQ(rules->belongings.at("diningtable").at("hall"), 0.5);
  EXPECT_EQ(rules->belongings.at("tvmonitor").at("hall"), 2.0);
  EXPECT_EQ(rules->metre_costs.at("attic"), 3.0);
  EXPECT_EQ(rules->tempering, 0.25);
  EXPECT_EQ(rules->min_probability, 0.75);
}

TEST_F(PlaceRulesFile, NamesHowLargeThingsAre) {
  const auto rules = read(
      "belongings: {cup: {kitchen: 2}}\nsizes:\n  TV: {longer: [0.4, 1.9], height: [0.3, 1]}\n");
  ASSERT_TRUE(rules) << to_string(rules.error());
  EXPECT_EQ(rules->sizes,
            (ClassSizes{{"tvmonitor",
                         {.longer = LengthRange{0.4, 1.9}, .height = LengthRange{0.3, 1.0}}}}));
}

TEST_F(PlaceRulesFile, SizesThatAreNoneAreNamed) {
  const auto error = [&](const std::string& sizes) {
    return read("belongings: {cup: {kitchen: 2}}\nsizes:\n  cup:\n    " + sizes + "\n").error();
  };
  EXPECT_EQ(error("height: [0.2, 0.1]").field, "sizes.cup.height");
  EXPECT_EQ(error("height: [0.2, 0.1]").line, 4);
  EXPECT_EQ(error("height: 0.2").field, "sizes.cup.height");
  EXPECT_EQ(error("height: [0.1, 0.2, 0.3]").field, "sizes.cup.height");
  EXPECT_EQ(error("{}").field, "sizes.cup");
  EXPECT_THAT(error("hight: [0.1, 0.2]").what, HasSubstr("did you mean \"height\""));
  EXPECT_EQ(error("height: [0.1, 0.2]\n  Cup: {height: [0.1, 0.2]}").field, "sizes.Cup");
}

TEST_F(PlaceRulesFile, TheShippedFileKnowsTheRoomsOfAHome) {
  const auto rules = read_place_rules(test::source_path("data/places.yaml"));
  ASSERT_TRUE(rules) << to_string(rules.error());
  const auto classifier = BelongingsClassifier::create(*rules).value();
  const auto place = [&](const ClassAmounts& amounts) {
    return classifier.decide(classifier.classify(amounts));
  };
  EXPECT_EQ(place({{"oven", 1}, {"sink", 1}, {"cup", 3}}), "kitchen");
  EXPECT_EQ(place({{"sofa", 1}, {"tvmonitor", 1}, {"chair", 2}}), "living room");
  EXPECT_EQ(place({{"bed", 1}, {"book", 1}, {"laptop", 1}}), "bedroom");
  EXPECT_EQ(place({{"toilet", 1}, {"sink", 1}}), "bathroom");
  EXPECT_EQ(place({{"keyboard", 1}, {"mouse", 1}, {"book", 4}}), "office");
  EXPECT_EQ(place({{"chair", 4}, {"person", 1}}), std::nullopt);
  EXPECT_LT(rules->sizes.at("cup").height->most_m, 0.2);
  EXPECT_GT(rules->sizes.at("sofa").longer->least_m, 1.0);
}

TEST_F(PlaceRulesFile, WhatIsWrongIsNamed) {
  const auto unknown = read("belongings: {}\ntemper: 1\n");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(unknown.error().line, 2);
  EXPECT_THAT(unknown.error().what, HasSubstr("did you mean \"tempering\""));
  const auto field = [&](const std::string& text) { return read(text).error().field; };
  EXPECT_EQ(field("belongings: {cup: {kitchen: often}}\n"), "belongings.cup.kitchen");
  EXPECT_EQ(field("belongings: {cup: {kitchen: 101}}\n"), "belongings.cup.kitchen");
  EXPECT_EQ(field("belongings: {cup: {kitchen: 2}}\ntempering: 0\n"), "tempering");
  EXPECT_EQ(field("belongings: {tv: {a: 2}, tvmonitor: {a: 2}}\n"), "belongings.tvmonitor");
  const auto line = [&](const std::string& text) { return read(text).error().line; };
  EXPECT_EQ(line("belongings:\n  Cup:\n    kitchen: 2\n    office: 101\n"), 4);
  EXPECT_EQ(line("belongings: {cup: {kitchen: 2}}\nmetre_costs:\n  kitchen: -1\n"), 3);
  EXPECT_EQ(line("belongings: {cup: {kitchen: 2}}\n\ntempering: 0\n"), 3);
  EXPECT_EQ(field("belongings: {}\n"), "places");
  EXPECT_THAT(read("belongings: {cup: {Dining Room: 2}, tv: {dining_room: 3}}\n").error().what,
              HasSubstr("\"dining_room\" is another spelling of \"Dining Room\""));
  EXPECT_EQ(field("tempering: 0.5\n"), "belongings");
  EXPECT_EQ(read("belongings: [cup]\n").error().code, ErrorCode::kMalformedFile);
  EXPECT_EQ(read_place_rules(dir_ / "absent.yaml").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
