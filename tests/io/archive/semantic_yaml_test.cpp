// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/semantic_yaml.hpp"

#include "support/hostile_index.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const SourceName kLayerSource{.file = "a.hmap", .entry = "semantic"};

Loaded<SemanticLayer> parsed_layer(const std::string& yaml) {
  auto layer = parse_semantic_layer(yaml, kLayerSource);
  EXPECT_TRUE(layer) << (layer ? "" : to_string(layer.error()));
  return layer ? *std::move(layer) : Loaded<SemanticLayer>{};
}

std::string refused_layer(const std::string& yaml) {
  const auto layer = parse_semantic_layer(yaml, kLayerSource);
  EXPECT_FALSE(layer) << yaml;
  return layer ? "" : to_string(layer.error());
}

TEST(SemanticYaml, AHandMadeFileIsReadWithItsComments) {
  const auto layer = parsed_layer(
      "# the laboratory\n"
      "- name: chair\n"
      "  shape: POLYGON((2.6 0.63, 2.1 0.63, 2.1 0, 2.6 0))\n"
      "- name: cup\n"
      "  shape: POLYGON((0 0, 1 0, 1 1, 0 1, 0 0)) #POLYGON((9 9))\n");
  ASSERT_EQ(layer.value.objects().size(), 2U);
  EXPECT_EQ(layer.value.objects()[0].id, 0U);
  EXPECT_EQ(layer.value.objects()[1].name, "cup");
  EXPECT_NEAR(area_m2(layer.value.objects()[0].parts[0]), 0.5 * 0.63, 1e-12);
  ASSERT_EQ(layer.findings.size(), 1U);
  EXPECT_EQ(to_string(layer.findings[0].error),
            "a.hmap!semantic: shape: 1 rings did not repeat their first point, read as closed");
}

TEST(SemanticYaml, TagsAndConfidencesAreRead) {
  const auto layer = parsed_layer(
      "- name: a\n"
      "  shape: POLYGON((0 0,1 0,1 1,0 0))\n"
      "  tags: [x, y]\n"
      "  confidence: [0.5, 0.25]\n"
      "- {name: b, shape: 'POLYGON((0 0,1 0,1 1,0 0))', tags: ~, confidence: 0.75}\n");
  EXPECT_THAT(layer.value.objects()[0].tags, ElementsAre("x", "y"));
  EXPECT_THAT(layer.value.objects()[0].confidence, ElementsAre(0.5, 0.25));
  EXPECT_THAT(layer.value.objects()[1].confidence, ElementsAre(0.75));
}

TEST(SemanticYaml, IdsAreKeptAndGapsAreFilledInFileOrder) {
  const std::string shape = ", shape: 'POLYGON((0 0,1 0,1 1,0 0))'";
  const auto layer = parsed_layer("- {name: a" + shape + "}\n- {name: b, id: 0" + shape +
                                  "}\n- {name: c, id: 7" + shape + "}\n- {name: d" + shape + "}\n");
  std::vector<std::string> names;
  for (const SemanticObject& object : layer.value.objects()) {
    names.push_back(std::to_string(object.id) + object.name);
  }
  EXPECT_THAT(names, ElementsAre("0b", "1a", "2d", "7c"));
  EXPECT_THAT(refused_layer("- {name: a, id: 3" + shape + "}\n- {name: b, id: 3" + shape + "}\n"),
              HasSubstr("[1] (b).id: is 3, which another entry bears"));
}

TEST(SemanticYaml, ErrorsNameEntryFieldLineAndColumn) {
  EXPECT_EQ(refused_layer("- name: ok\n  shape: POLYGON((0 0,1 0,1 1,0 0))\n"
                          "- name: bad\n  shape: POLYGON((0 0,nan 0,1 1))\n"),
            "a.hmap!semantic:4: [1] (bad).shape: column 14: is 'nan 0,1 1))', expected a finite "
            "number");
  EXPECT_THAT(refused_layer("- shape: POLYGON((0 0,1 0,1 1,0 0))\n"),
              HasSubstr("[0].name: the key is"));
  EXPECT_THAT(refused_layer("- name: a\n"), HasSubstr("[0] (a).shape: the key is missing"));
  EXPECT_THAT(refused_layer("- {name: a, shape: [1]}\n"), HasSubstr("expected text"));
  EXPECT_THAT(refused_layer("a: 1\n"), HasSubstr("is a map, expected a list"));
  EXPECT_THAT(refused_layer("- 1\n"), HasSubstr("[0]: is '1', expected a map"));
  const std::string good = "- name: a\n  shape: POLYGON((0 0,1 0,1 1,0 0))\n";
  for (const char* bad : {".nan", "2", "-1", "[0.5]", "high", "{a: 1}"}) {
    EXPECT_THAT(refused_layer(good + "  confidence: " + bad + "\n"), HasSubstr("(a).confidence"))
        << bad;
  }
  EXPECT_THAT(refused_layer(good + "  tags: x\n"), HasSubstr("(a).tags"));
  EXPECT_THAT(refused_layer(good + "  id: -1\n"), HasSubstr("(a).id"));
}

TEST(SemanticYaml, BadEntriesAreLeftOutOnDemandAndNamed) {
  const auto layer = parse_semantic_layer(
      "- {name: a, shape: POINT}\n- {name: b, shape: 'POLYGON((0 0,1 0,1 1,0 0))'}\n",
      kLayerSource,
      {.skip_bad = true});
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->value.objects().size(), 1U);
  ASSERT_EQ(layer->findings.size(), 1U);
  EXPECT_EQ(layer->findings[0].severity, Severity::kError);
  EXPECT_THAT(layer->findings[0].error.field, HasSubstr("[0] (a).shape"));
}

TEST(SemanticYaml, UnknownKeysSurviveLoadAndSave) {
  const auto layer = parsed_layer(
      "- name: a\n  shape: POLYGON((0 0,1 0,1 1,0 0))\n  colour: {r: 1, list: [x, '7']}\n  conf: "
      "1\n");
  ASSERT_EQ(layer.findings.size(), 2U);
  EXPECT_EQ(parsed_layer(write_semantic_layer(layer.value)).value, layer.value);
}

TEST(SemanticYaml, NamesThatAreYamlAreQuotedAndRoundTripExactly) {
  std::vector<SemanticObject> objects;
  for (const char* name : {"- x: y",
                           "a\nb",
                           "123",
                           "true",
                           "~",
                           " lead",
                           "caf\xC3\xA9 \xE6\x9C\xBA \xF0\x9F\xAA\x91",
                           "a: b # c",
                           "'",
                           "\"",
                           "{}",
                           "null",
                           "x\\y",
                           "\x01",
                           "!t",
                           "&a",
                           "*a"}) {
    objects.push_back({.id = objects.size(),
                       .name = name,
                       .parts = {*make_polygon({{0, 0}, {1.0 / 3.0, 0}, {1, 1e-7}})},
                       .tags = {name, "t"},
                       .confidence = {0.1, 1.0 / 3.0}});
  }
  const SemanticLayer layer = *SemanticLayer::create(objects);
  const std::string text = write_semantic_layer(layer);
  auto again = parsed_layer(text).value;
  ASSERT_EQ(again.objects().size(), layer.objects().size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(again.objects()[i].name, objects[i].name);
    EXPECT_EQ(again.objects()[i].tags, objects[i].tags);
    EXPECT_EQ(again.objects()[i].parts, objects[i].parts);
    EXPECT_EQ(again.objects()[i].confidence, objects[i].confidence);
  }
  EXPECT_EQ(write_semantic_layer(again), text);
}

TEST(SemanticYaml, UneditedShapesStayAsTheyWereAndEditedOnesAreWritten) {
  const std::string wound = "POLYGON((0 0,1 0,1 1,0 1,0 0,1 0,1 1,0 1,0 0))";
  const std::string open = "POLYGON((2.60 0.630, 2.1 0.63, 2.1 0))";
  SemanticLayer layer =
      parsed_layer("- {name: a, shape: '" + wound + "'}\n- {name: b, shape: '" + open + "'}\n")
          .value;
  EXPECT_THAT(write_semantic_layer(layer), HasSubstr("shape: " + wound + "\n"));
  EXPECT_THAT(write_semantic_layer(layer), HasSubstr("shape: " + open + "\n"));
  SemanticObject edited = layer.objects()[1];
  edited.parts = {translated(edited.parts[0], {1, 0})};
  ASSERT_TRUE(layer.replace(edited));
  EXPECT_THAT(write_semantic_layer(layer), ::testing::Not(HasSubstr(open)));
  EXPECT_EQ(parsed_layer(write_semantic_layer(layer)).value.objects()[1].parts, edited.parts);
}

TEST(SemanticYaml, ALayerThatNobodyReadFromAFileRoundTripsToAnEqualOne) {
  SemanticObject object;
  object.name = "sink";
  object.parts = {*make_polygon({{0.1, 0}, {1.0 / 3.0, 0}, {0.3, 1}})};
  const auto layer = SemanticLayer::create({object});
  ASSERT_TRUE(layer);
  const auto again = parse_semantic_layer(write_semantic_layer(*layer), {.file = "semantic"});
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_TRUE(again->value == *layer);
}

TEST(SemanticYaml, AnEmptyLayerRoundTrips) {
  EXPECT_EQ(write_semantic_layer(SemanticLayer()), "[]\n");
  EXPECT_TRUE(parsed_layer("[]\n").value.objects().empty());
}

class HostileWkt : public ::testing::TestWithParam<std::string> {};

TEST_P(HostileWkt, GivesWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto layer = read_semantic_layer(test::shared_data("hostile/wkt") / GetParam());
  if (GetParam().starts_with("ok_")) {
    ASSERT_TRUE(layer) << to_string(layer.error());
    EXPECT_EQ(layer->value.objects().size(), 1U);
    return;
  }
  ASSERT_FALSE(layer);
  const std::string message = to_string(layer.error());
  EXPECT_THAT(message, HasSubstr(GetParam()));
  EXPECT_THAT(layer.error().field, HasSubstr("[0]"));
  EXPECT_LT(message.size(), 600U);
}

INSTANTIATE_TEST_SUITE_P(Corpus,
                         HostileWkt,
                         ::testing::ValuesIn(test::hostile_names("wkt")),
                         [](const auto& file) { return test::test_name_of(file.param); });

TEST(SemanticYaml, TheCorpusShapesHaveTheirAreas) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/wkt");
  const auto shape_of = [](const char* name) {
    return read_semantic_layer(test::shared_data("hostile/wkt") / name)
        ->value.objects()[0]
        .parts[0];
  };
  EXPECT_DOUBLE_EQ(area_m2(shape_of("ok_square_ccw.yaml")), 1.0);
  EXPECT_DOUBLE_EQ(area_m2(shape_of("ok_not_closed.yaml")), 1.0);
  EXPECT_DOUBLE_EQ(area_m2(shape_of("ok_with_hole.yaml")), 15.0);
  EXPECT_FALSE(contains(shape_of("ok_with_hole.yaml"), {1.5, 1.5}));
}

TEST(SemanticYaml, TheLaboratoryHasTwentyEightObjects) {
  HYPERMAP_REQUIRE_SHARED_DATA("hmap/semantic_gt_2019-04-23-12-51-46_v3.yaml");
  const auto layer =
      read_semantic_layer(test::shared_data("hmap/semantic_gt_2019-04-23-12-51-46_v3.yaml"));
  ASSERT_TRUE(layer) << to_string(layer.error());
  EXPECT_EQ(layer->value.objects().size(), 28U);
}

TEST(SemanticYaml, MoreObjectsThanOtherTextsMayHaveAreRead) {
  constexpr std::size_t kCount = 150'000;
  std::string yaml;
  for (std::size_t i = 0; i < kCount; ++i) {
    yaml +=
        "- name: a class with a name that is not short at all, so that the text is long\n"
        "  shape: POLYGON((0 0,1 0,1 1,0 0))\n  tags: ~\n  confidence: 0.5\n";
  }
  ASSERT_GT(yaml.size(), YamlLimits{}.max_bytes);
  EXPECT_EQ(parsed_layer(yaml).value.objects().size(), kCount);
  SemanticReadOptions few;
  few.yaml.max_bytes = 1000;
  const auto refused = parse_semantic_layer(yaml, kLayerSource, few);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_THAT(refused.error().what, HasSubstr("the limit for YAML is 1000"));
}

}  // namespace
}  // namespace hypermap
