// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/options_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
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
             "projection: {max_height_m: 0.6}\n");
  const auto options = read_options(dir / "o.yaml", {});
  ASSERT_TRUE(options) << to_string(options.error());
  MapOptions expected;
  expected.mapper.octree.resolution_m = 0.1;
  expected.mapper.integration.mode = IntegrationMode::kExact;
  expected.mapper.objects.segmentation.foreground.max_planes = 5;
  expected.mapper.objects.publication.min_existence = std::nullopt;
  expected.mapper.objects.transient_class_names = {"person", "cat"};
  expected.layers.max_height_m = 0.6;
  EXPECT_EQ(*options, expected);
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
}

TEST(OptionsFile, ValuesOutOfRangeAreRefusedWithTheirPlace) {
  EXPECT_THAT(options_refusal("\noctree: {resolution_m: 0}\n"),
              HasSubstr("o.yaml:2: octree.resolution_m"));
  EXPECT_THAT(options_refusal("octree: {resolution_m: wide}\n"), HasSubstr("octree.resolution_m"));
  EXPECT_THAT(options_refusal("integration: {mode: fast}\n"),
              HasSubstr("must be one of exact, discretize, projective"));
  EXPECT_THAT(options_refusal("absence: {spare_seen: 2}\n"), HasSubstr("absence.spare_seen"));
  EXPECT_THAT(options_refusal("association: {histogram: {weights: [1, 2]}}\n"),
              HasSubstr("must have 5"));
  EXPECT_THAT(options_refusal("segmentation: {min_range_m: 9}\n"), HasSubstr("max_range_m"));
  EXPECT_THAT(options_refusal("octree: 3\n"), HasSubstr("octree"));
  EXPECT_THAT(options_refusal("projection: {min_height_m: 2}\n"), HasSubstr("max_height_m"));
}

TEST(OptionsFile, AnOptionIsSetByItsName) {
  const auto options = with_option({}, "octree.resolution_m", "0.02");
  ASSERT_TRUE(options) << to_string(options.error());
  EXPECT_EQ(options->mapper.octree.resolution_m, 0.02);
  EXPECT_THAT(to_string(with_option({}, "octree.resolution_m", "nan").error()),
              HasSubstr("octree.resolution_m"));
}

/// Names of the fields of `struct name` in a header of ours, those with a default value.
std::vector<std::string> fields_of(const std::string& header, const std::string& name) {
  std::ifstream file(test::source_path(header));
  std::vector<std::string> fields;
  bool is_inside = false;
  const std::regex field(R"(^  [\w:<>, ]+ (\w+)(\{| =).*)");
  for (std::string line; std::getline(file, line);) {
    if (line == "struct " + name + " {") is_inside = true;
    if (line == "};") is_inside = false;
    std::smatch match;
    if (is_inside && std::regex_match(line, match, field)) fields.push_back(match[1]);
  }
  return fields;
}

TEST(OptionsFile, NoFieldOfTheOptionsIsForgotten) {
  const std::string core = "core/include/hypermap/core/";
  const std::string octree = "octree_semantic/include/hypermap/octree_semantic/";
  const std::pair<std::string, std::string> structs[] = {
      {octree + "octree/semantic_octree.hpp", "OctreeOptions"},
      {octree + "octree/sensor_model.hpp", "SensorModelOptions"},
      {octree + "occlusion/object_visibility.hpp", "VisibilityOptions"},
      {core + "segmentation/geometric_segmentation.hpp", "GeometricSegmentationOptions"},
      {core + "segmentation/geometric_segmentation.hpp", "ForegroundOptions"},
      {core + "segmentation/geometric_segmentation.hpp", "RegionGrowingOptions"},
      {core + "objects/association.hpp", "AssociationOptions"},
      {core + "objects/association.hpp", "AssignmentOptions"},
      {core + "objects/class_belief.hpp", "ClassBeliefOptions"},
      {core + "objects/visibility_histogram.hpp", "VisibilityHistogramOptions"},
      {core + "geometry/footprint.hpp", "PointEvidenceOptions"},
      {core + "segmentation/binned_depth_map.hpp", "BinnedDepthMapOptions"},
      {core + "objects/absence.hpp", "AbsenceOptions"},
      {core + "objects/publication.hpp", "PublicationOptions"},
      {"projection/include/hypermap/projection/grids/layer_options.hpp", "LayerOptions"}};
  const std::set<std::string> elsewhere{"sensor_model", "transient_classes"};
  const auto options = describe_options({});
  for (const auto& [header, name] : structs) {
    const auto fields = fields_of(header, name);
    EXPECT_THAT(fields, ::testing::Not(::testing::IsEmpty())) << name;
    for (const std::string& field : fields) {
      if (elsewhere.contains(field)) continue;
      EXPECT_TRUE(std::any_of(options.begin(),
                              options.end(),
                              [&](const auto& option) {
                                return option.name.ends_with("." + field) ||
                                       option.name.find("." + field + ".") != std::string::npos;
                              }))
          << name << "." << field << " has no row in io/src/options_of_*.cpp";
    }
  }
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
      << "regenerate: HYPERMAP_WRITE_GOLDEN=1 io_dataset_tests --gtest_filter='*ShippedOptions*'";
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
