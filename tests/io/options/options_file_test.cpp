// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/options_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;

MapOptions with_preset(PresetName name) {
  MapOptions options;
  options.mapper.objects = preset(name);
  return options;
}

std::string value_of(const MapOptions& options, const std::string& name) {
  for (const OptionDescription& option : describe_options(options)) {
    if (option.name == name) return option.value;
  }
  return "no such option";
}

std::string options_refusal(const std::string& text) {
  const TempDir dir;
  write_text(dir / "o.yaml", text);
  const auto options = read_options(dir / "o.yaml", {});
  return options ? "was accepted" : to_string(options.error());
}

TEST(OptionsFile, EachOptionHasANameARangeASourceAndAnEffect) {
  std::set<std::string> names;
  for (const OptionDescription& option : describe_options({})) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name << " is there twice";
    EXPECT_FALSE(option.range.empty()) << option.name;
    EXPECT_FALSE(option.source.empty()) << option.name;
    EXPECT_FALSE(option.effect.empty()) << option.name;
    EXPECT_FALSE(option.value.empty()) << option.name;
  }
  EXPECT_GT(names.size(), 100U);
}

TEST(OptionsFile, SectionsNestAndOnlyWhatIsNamedChanges) {
  const TempDir dir;
  write_text(dir / "o.yaml",
             "octree: {resolution_m: 0.1}\n"
             "integration:\n  mode: exact\n"
             "segmentation:\n  foreground:\n    max_planes: 5\n"
             "publication: {min_existence: none}\n"
             "transient_classes: [person, cat]\n"
             "wanted_classes: [chair]\n"
             "projection: {max_height_m: 0.6}\n");
  const auto options = read_options(dir / "o.yaml", {});
  ASSERT_TRUE(options) << to_string(options.error());
  MapOptions expected;
  expected.mapper.octree.resolution_m = 0.1;
  expected.mapper.integration.mode = IntegrationMode::kExact;
  expected.mapper.objects.segmentation.foreground.max_planes = 5;
  expected.mapper.objects.confirmation.min_existence = std::nullopt;
  expected.mapper.objects.transient_class_names = {"person", "cat"};
  expected.mapper.wanted_class_names = {"chair"};
  expected.layers.max_height_m = 0.6;
  EXPECT_EQ(*options, expected);
}

TEST(OptionsFile, WeightsOfDetectorsGoByName) {
  const TempDir dir;
  write_text(dir / "o.yaml", "stacking: {rule: weighted, weights: {yolo: 2, \"no\": 0.5}}\n");
  const auto options = read_options(dir / "o.yaml", {});
  ASSERT_TRUE(options) << to_string(options.error());
  MapOptions expected;
  expected.mapper.objects.stacking.rule = StackingRule::kWeighted;
  expected.mapper.objects.stacking.weights = {{"yolo", 2.0}, {"no", 0.5}};
  EXPECT_EQ(*options, expected);
  write_text(dir / "again.yaml", write_options(*options));
  EXPECT_EQ(read_options(dir / "again.yaml", {}).value(), expected);
  EXPECT_EQ(with_option(*options, "stacking.weights", "{}")->mapper.objects.stacking.weights.size(),
            0U);
  EXPECT_THAT(options_refusal("stacking: {weights: {yolo: -2}}\n"),
              HasSubstr("o.yaml:1: stacking.weights: each must be in 0.000001 .. 1000000, that of "
                        "\"yolo\" is -2"));
  EXPECT_THAT(options_refusal("stacking: {weights: {yolo: much}}\n"),
              HasSubstr("stacking.weights.yolo"));
  EXPECT_THAT(options_refusal("stacking: {weights: [2, 1]}\n"), HasSubstr("stacking.weights"));
}

TEST(OptionsFile, APresetIsTheBaseOfTheOtherKeys) {
  const TempDir dir;
  write_text(dir / "o.yaml", "segmentation: {max_range_m: 3}\npreset: smap\n");
  const auto options = read_options(dir / "o.yaml", {});
  ASSERT_TRUE(options) << to_string(options.error());
  MapOptions expected = with_preset(PresetName::kSmap);
  expected.mapper.objects.segmentation.max_range_m = 3.0;
  EXPECT_EQ(*options, expected);
}

TEST(OptionsFile, UnknownNamesAreRefusedWithTheNearestOne) {
  EXPECT_THAT(
      options_refusal("octree: {resolution: 0.1}\n"),
      HasSubstr("o.yaml:1: octree.resolution: unknown option \"octree.resolution\", did you "
                "mean \"octree.resolution_m\"?"));
  EXPECT_THAT(options_refusal("segmentaton:\n  max_range_m: 3\n"),
              HasSubstr("did you mean \"segmentation\""));
  EXPECT_THAT(to_string(with_option({}, "absence.removel", "existence").error()),
              HasSubstr("did you mean \"absence.removal\"?"));
  EXPECT_THAT(to_string(with_option({}, "absence", "0.1").error()),
              HasSubstr("\"absence\" is a group of options, such as \"absence."));
  EXPECT_THAT(to_string(with_option({}, "absenc", "0.1").error()),
              Not(HasSubstr("did you mean \"absence\"")));
}

TEST(OptionsFile, ValuesOutOfRangeAreRefusedWithTheirPlace) {
  EXPECT_THAT(options_refusal("\noctree: {resolution_m: 0}\n"),
              HasSubstr("o.yaml:2: octree.resolution_m"));
  EXPECT_THAT(options_refusal("octree: {resolution_m: wide}\n"), HasSubstr("octree.resolution_m"));
  EXPECT_THAT(options_refusal("integration: {mode: fast}\n"),
              HasSubstr("must be one of exact, discretize, projective"));
  EXPECT_THAT(options_refusal("absence: {spare_seen: 2}\n"), HasSubstr("absence.spare_seen"));
  EXPECT_THAT(options_refusal("association: {histogram: {weights: [1, 2]}}\n"),
              HasSubstr("expected 5 numbers"));
  EXPECT_THAT(options_refusal("segmentation: {min_range_m: 9}\n"), HasSubstr("max_range_m"));
  EXPECT_THAT(options_refusal("octree: 3\n"), HasSubstr("octree"));
  EXPECT_THAT(options_refusal("projection: {min_height_m: 2}\n"), HasSubstr("max_height_m"));
}

TEST(OptionsFile, LimitsOfAnOptionAreTheSameInAFileAndInCode) {
  MapOptions options;
  options.mapper.octree.resolution_m = 12;
  EXPECT_EQ(to_string(validate(options).error()),
            "octree.resolution_m: must be in 0.001 .. 10, is 12");
  EXPECT_EQ(to_string(with_option({}, "octree.resolution_m", "12").error()),
            "octree.resolution_m: must be in 0.001 .. 10, is 12");
  EXPECT_THAT(options_refusal("octree: {resolution_m: 12}\n"),
              HasSubstr("o.yaml:1: octree.resolution_m: must be in 0.001 .. 10, is 12"));
}

TEST(OptionsFile, ARefusalNamesTheWholeWayToTheField) {
  MapOptions options;
  options.mapper.objects.association.belief.min_log_odds = LogOdds(40.0);
  EXPECT_EQ(validate(options).error().field, "association.belief.min_log_odds");
  options = {};
  options.layers.min_free_share = 0.0;
  EXPECT_EQ(validate(options).error().field, "projection.min_free_share");
  options = {};
  options.mapper.objects.confirmation.min_existence = LogOdds(std::nan(""));
  EXPECT_EQ(validate(options).error().field, "publication.min_existence");
}

TEST(OptionsFile, AValueIsCheckedByItselfOrWithTheOthers) {
  EXPECT_TRUE(check_option("segmentation.min_range_m", "9"));
  EXPECT_EQ(to_string(with_option({}, "segmentation.min_range_m", "9").error()),
            "segmentation.max_range_m: must be above min_range_m (9), is 5");
  EXPECT_EQ(to_string(check_option("segmentation.min_range_m", "-1").error()),
            "segmentation.min_range_m: must be in 0 .. 100, is -1");
}

TEST(OptionsFile, ARangeIsSetApartOrFollows) {
  const auto apart = with_option({}, "segmentation.max_range_m", "2.5");
  ASSERT_TRUE(apart) << to_string(apart.error());
  EXPECT_EQ(apart->mapper.objects.segmentation.max_range_m, 2.5);
  const auto following = with_option(*apart, "segmentation.max_range_m", "none");
  ASSERT_TRUE(following) << to_string(following.error());
  EXPECT_EQ(*following, MapOptions{});
  EXPECT_EQ(value_of({}, "segmentation.max_range_m"), "none");
  EXPECT_EQ(value_of({}, "integration.max_range_m"), "5");
}

TEST(OptionsFile, AnOptionIsSetByItsName) {
  const auto options = with_option({}, "octree.resolution_m", "0.02");
  ASSERT_TRUE(options) << to_string(options.error());
  EXPECT_EQ(options->mapper.octree.resolution_m, 0.02);
  EXPECT_THAT(to_string(with_option({}, "octree.resolution_m", "nan").error()),
              HasSubstr("octree.resolution_m"));
}

class ShippedOptions : public ::testing::TestWithParam<PresetName> {};

TEST_P(ShippedOptions, AreTheNamedSetAndWhatIsWrittenNow) {
  const std::string name(to_string(GetParam()));
  const auto path = test::source_path("data/options/" + name + ".yaml");
  if (std::getenv("HYPERMAP_WRITE_GOLDEN") != nullptr) {
    write_text(path, write_options(with_preset(GetParam())));
  }
  const auto options = read_options(path, {});
  ASSERT_TRUE(options) << to_string(options.error());
  EXPECT_TRUE(*options == with_preset(GetParam())) << "the file is not the set any more";
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_TRUE(text == write_options(with_preset(GetParam())))
      << "regenerate: HYPERMAP_WRITE_GOLDEN=1 io_options_tests --gtest_filter='*ShippedOptions*'";
}

INSTANTIATE_TEST_SUITE_P(Default, ShippedOptions, ::testing::Values(PresetName::kDefault));
INSTANTIATE_TEST_SUITE_P(Smap, ShippedOptions, ::testing::Values(PresetName::kSmap));
INSTANTIATE_TEST_SUITE_P(Hypermap, ShippedOptions, ::testing::Values(PresetName::kHypermap));

TEST(OptionsFile, TheSmapSetIsThatOfTablesD1AndD2) {
  const auto options = read_options(test::source_path("data/options/smap.yaml"), {});
  ASSERT_TRUE(options) << to_string(options.error());
  const std::pair<const char*, const char*> printed[] = {
      // Table D.1
      {"segmentation.policy", "cluster"},
      {"segmentation.min_range_m", "0.2"},
      {"segmentation.max_range_m", "1.7"},
      {"segmentation.leaf_size_m", "0.03"},
      {"segmentation.outlier_neighbours", "8"},
      {"segmentation.outlier_stddev", "0.3"},
      {"segmentation.cluster_min_points", "50"},
      {"segmentation.cluster_max_points", "10000"},
      {"segmentation.cluster_gap_m", "0.065"},
      {"segmentation.depth_slack_m", "0.2"},
      // Table D.2
      {"binned_depth.columns", "24"},
      {"binned_depth.rows", "16"},
      {"association.policy", "smap"},
      {"association.histogram.base_increment", "2"},
      {"association.histogram.weights", "[0.5, 1.5, 6, 1.5, 0.5]"},
      {"association.histogram.min_log_odds", "-10"},
      {"association.histogram.max_log_odds", "10"},
      {"association.belief.min_log_odds", "-10"},
      {"association.belief.max_log_odds", "10"},
      {"association.position_error_m", "0.2"},
      {"association.tracking_factor", "0.5"},
      {"absence.min_confidence", "0.5"},
      {"association.histogram.visible_above", "0.7"},
      {"association.histogram.hidden_below", "0.4"},
      {"absence.confidence.rule", "weighted"},
      {"publication.confidence.rule", "weighted"},
  };
  for (const auto& [name, value] : printed) EXPECT_EQ(value_of(*options, name), value) << name;
}

}  // namespace
}  // namespace hypermap
