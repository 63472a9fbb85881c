// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/hypermap_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const SourceName kTestSource{.file = "a.hmap", .entry = "hmap_config.yaml"};

constexpr const char* kExample = R"(layers:
  - {class: OccupancyGridLayer, name: occupancy, frame_id: map, load_file: true, file: map}
  - {load_file: false, frame_id: lab, name: semantic, class: SemanticLayer, subscribe_mode: true}
transforms:
  - {frame_id: map, child_frame_id: lab, transform_pose: [1, 2.5, 0.1]}
extensions:
  - {format: octomap, version: 1, name: octree, frame_id: map, file: octree.ot, colour: red}
  - {format: weather, version: 9, anything: [1, 2]}
layer_cnt: 2
)";

std::string error_of(const std::string& text) {
  const auto config = parse_hypermap_config(text, kTestSource);
  return config ? "no error" : to_string(config.error());
}

std::string layer(const std::string& entry) {
  return "layers:\n  - {" + entry + "}\n";
}

TEST(HypermapConfig, ReadsLayersTransformsAndExtensions) {
  const auto loaded = parse_hypermap_config(kExample, kTestSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const HypermapConfig& config = loaded->value;
  ASSERT_EQ(config.layers.size(), 2U);
  EXPECT_EQ(config.layers[0].class_name, "OccupancyGridLayer");
  EXPECT_EQ(config.layers[0].info.file, "map");
  EXPECT_FALSE(config.layers[0].info.subscribe_mode.has_value());
  EXPECT_FALSE(config.layers[1].info.load_file);
  EXPECT_FALSE(config.layers[1].info.file.has_value());
  EXPECT_EQ(config.layers[1].info.subscribe_mode, true);
  ASSERT_EQ(config.frames.transforms().size(), 1U);
  EXPECT_EQ(config.frames.transforms()[0].y_m, 2.5);
  ASSERT_EQ(config.extensions.size(), 1U);
  EXPECT_EQ(config.extensions[0].file, "octree.ot");
  ASSERT_NE(config.extensions[0].extra.find("colour"), nullptr);
  EXPECT_EQ(config.foreign_extensions.size(), 1U);
  EXPECT_NE(config.extra.find("layer_cnt"), nullptr);
}

TEST(HypermapConfig, UnknownKeysAndFormatsAreFindingsAndSurvive) {
  const auto loaded = parse_hypermap_config(kExample, kTestSource);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->findings.size(), 2U);  // format weather, layer_cnt
  const std::string text = write_hypermap_config(loaded->value);
  const auto again = parse_hypermap_config(text, kTestSource);
  ASSERT_TRUE(again) << to_string(again.error()) << text;
  EXPECT_EQ(again->value.layers, loaded->value.layers);
  EXPECT_EQ(again->value.frames, loaded->value.frames);
  EXPECT_EQ(again->value.extensions, loaded->value.extensions);
  EXPECT_EQ(again->value.foreign_extensions, loaded->value.foreign_extensions);
  EXPECT_EQ(again->value.extra, loaded->value.extra);
  EXPECT_EQ(write_hypermap_config(again->value), text);
}

TEST(HypermapConfig, NumbersKeepAllTheirDigits) {
  HypermapConfig config{.layers = {}};
  ASSERT_TRUE(config.frames.add({.frame_id = "map",
                                 .child_frame_id = "lab",
                                 .x_m = 0.1,
                                 .y_m = 1.0 / 3.0,
                                 .yaw_rad = 3.141592653589793}));
  const auto again = parse_hypermap_config(write_hypermap_config(config), kTestSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->value.frames, config.frames);
}

TEST(HypermapConfig, WithoutExtensionsTheFormIsThatOfTheFirstImplementation) {
  const HypermapConfig config{.layers = {{.class_name = "SemanticLayer",
                                          .info = {.name = "semantic", .file = "semantic"}}}};
  const std::string text = write_hypermap_config(config);
  EXPECT_THAT(text, Not(HasSubstr("extensions")));
  EXPECT_THAT(text, Not(HasSubstr("format_version")));
  EXPECT_TRUE(text.starts_with("layers:"));
}

TEST(HypermapConfig, EachRequiredKeyIsNamedWhenItIsMissing) {
  EXPECT_THAT(error_of("transforms: []\n"), HasSubstr("layers"));
  EXPECT_THAT(error_of(layer("name: a, frame_id: map, load_file: true")), HasSubstr("class"));
  EXPECT_THAT(error_of(layer("class: A, frame_id: map, load_file: true")), HasSubstr("name"));
  EXPECT_THAT(error_of(layer("class: A, name: a, load_file: true")), HasSubstr("frame_id"));
  EXPECT_THAT(error_of(layer("class: A, name: a, frame_id: map")), HasSubstr("load_file"));
}

TEST(HypermapConfig, WrongTypesAndNamesAreErrorsWithFieldAndLine) {
  const std::string rest = "class: A, frame_id: map, load_file: true, name: ";
  EXPECT_THAT(error_of(layer(rest + "../x")),
              HasSubstr("a.hmap!hmap_config.yaml:2: layers[0].name"));
  EXPECT_THAT(error_of(layer(rest + "''")), HasSubstr("layers[0].name"));
  EXPECT_THAT(error_of(layer(rest + "a, file: [1]")), HasSubstr("layers[0].file"));
  EXPECT_THAT(error_of(layer(rest + "a, enable_update: 7")), HasSubstr("layers[0].enable_update"));
  EXPECT_THAT(error_of("layers: 3\n"), HasSubstr("layers"));
  EXPECT_THAT(error_of("layers:\n  - {" + rest + "a}\n  - {" + rest + "a}\n"), HasSubstr("twice"));
  EXPECT_THAT(error_of("layers: []\ntransforms:\n  - {frame_id: a, child_frame_id: b, "
                       "transform_pose: [1, 2]}\n"),
              HasSubstr("transforms[0].transform_pose"));
  EXPECT_THAT(error_of("layers: []\ntransforms:\n  - {frame_id: a, child_frame_id: a, "
                       "transform_pose: [1, 2, 3]}\n"),
              HasSubstr("transforms[0]"));
}

TEST(HypermapConfig, NewerVersionsAreRefusedByTheirNumber) {
  EXPECT_THAT(error_of("layers: []\nformat_version: 3\n"),
              HasSubstr("written by a newer version 3"));
  EXPECT_THAT(error_of("layers: []\nextensions:\n  - {format: octomap, version: 2, name: o, "
                       "frame_id: map, file: o.ot}\n"),
              HasSubstr("written by a newer version 2"));
}

TEST(HypermapConfig, TooManyLayersAreRefused) {
  std::string text = "layers:\n";
  for (int i = 0; i < 257; ++i)
    text += "  - {class: A, frame_id: map, load_file: true, name: l" + std::to_string(i) + "}\n";
  EXPECT_THAT(error_of(text), HasSubstr("257 entries, the limit is 256"));
}

}  // namespace
}  // namespace hypermap
