// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_server.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "support/hostile_index.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const SourceName kMapSource{.file = "map.yaml"};
const std::string kGood =
    "image: a.pgm\nresolution: 0.05\norigin: [-1, -2, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

std::string refused_map(const std::string& yaml) {
  const auto metadata = parse_map_metadata(yaml, kMapSource);
  EXPECT_FALSE(metadata) << yaml;
  return metadata ? "" : to_string(metadata.error());
}

DecodedImage gray(std::vector<std::uint8_t> samples, int channels = 1) {
  const int width_px = static_cast<int>(samples.size()) / channels;
  return {
      .width_px = width_px, .height_px = 1, .channels = channels, .samples8 = std::move(samples)};
}

std::vector<int> cells(const DecodedImage& image, const MapMetadata& metadata, MapDialect dialect) {
  const auto grid = grid_from_image(image, metadata, dialect);
  EXPECT_TRUE(grid);
  return {grid->value.cells().begin(), grid->value.cells().end()};
}

TEST(MapServer, TheMetadataIsRead) {
  const auto metadata =
      parse_map_metadata(kGood + "mode: scale\nmap_type: occupancy\n", kMapSource);
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->value.image, "a.pgm");
  EXPECT_EQ(metadata->value.resolution_m, 0.05);
  EXPECT_THAT(metadata->value.origin, ElementsAre(-1, -2, 0.5));
  EXPECT_EQ(metadata->value.mode, MapMode::kScale);
  EXPECT_EQ(metadata->findings.size(), 1U);
  EXPECT_NE(metadata->value.extra.find("map_type"), nullptr);
  EXPECT_EQ(parse_map_metadata(kGood, kMapSource)->value.mode, MapMode::kTrinary);
}

TEST(MapServer, FieldsOutsideTheirRangeAreNamedWithTheirLine) {
  EXPECT_THAT(refused_map(kGood + "mode: both\n"), HasSubstr("map.yaml:7: mode: is 'both'"));
  EXPECT_THAT(refused_map("a: 1\n"), HasSubstr("image: the key is missing"));
  EXPECT_THAT(refused_map("- 1\n"), HasSubstr("expected a map"));
  const auto with = [](const std::string& from, const std::string& to) {
    std::string yaml = kGood;
    return refused_map(yaml.replace(yaml.find(from), from.size(), to));
  };
  EXPECT_THAT(with("0.05", "1e-7"), HasSubstr("map.yaml:2: resolution"));
  EXPECT_THAT(with("0.05", "1001"), HasSubstr("resolution"));
  EXPECT_THAT(with("0.05", "0,05"), HasSubstr("resolution"));
  EXPECT_THAT(with("-1,", "1e18,"), HasSubstr("origin"));
  EXPECT_THAT(with("-1,", ""), HasSubstr("expected 3 numbers"));
  EXPECT_THAT(with("0.65", "1.5"), HasSubstr("occupied_thresh"));
  EXPECT_THAT(with("0.65", "0.1"), HasSubstr("below free_thresh"));
  EXPECT_THAT(with("negate: 0", "negate: 2"), HasSubstr("negate"));
}

TEST(MapServer, TrinaryComparesStrictly) {
  // p = (255 - c) / 255; with thresholds 0.6 and 0.2: c = 102 is exactly 0.6, c = 204 exactly 0.2.
  const MapMetadata metadata{.image = "a", .occupied_thresh = 0.6, .free_thresh = 0.2};
  EXPECT_THAT(cells(gray({0, 101, 102, 204, 205, 255}), metadata, MapDialect::kHypermap),
              ElementsAre(100, 100, -1, -1, 0, 0));
  MapMetadata negated = metadata;
  negated.negate = true;
  EXPECT_THAT(cells(gray({0, 50, 51, 153, 154, 255}), negated, MapDialect::kHypermap),
              ElementsAre(0, 0, -1, -1, 100, 100));
}

TEST(MapServer, ScaleIsAHundredRInTheThesisAndNinetyNineInRos) {
  // Source: [hypermap] 3.3.5. c = 100, thresholds 1 and 0: r = 155 / 255 = 0.6078:
  // 60.78 -> 61 rounded; 99 r = 60.17 -> 60 cut.
  const MapMetadata metadata{
      .image = "a", .occupied_thresh = 1.0, .free_thresh = 0.0, .mode = MapMode::kScale};
  EXPECT_THAT(cells(gray({100, 0, 255}), metadata, MapDialect::kHypermap), ElementsAre(61, 100, 0));
  EXPECT_THAT(cells(gray({100, 0, 255}), metadata, MapDialect::kMapServer), ElementsAre(60, 99, 0));
}

TEST(MapServer, RawValuesAreTakenAsTheyAre) {
  const MapMetadata metadata{.image = "a", .mode = MapMode::kRaw};
  const DecodedImage image = gray({0, 100, 101, 200, 255});
  EXPECT_THAT(cells(image, metadata, MapDialect::kHypermap), ElementsAre(0, 100, -1, -1, -1));
  EXPECT_THAT(cells(image, metadata, MapDialect::kMapServer), ElementsAre(0, 100, -1, -1, -1));
  const auto grid = grid_from_image(image, metadata, MapDialect::kHypermap);
  ASSERT_EQ(grid->findings.size(), 1U);
  EXPECT_THAT(grid->findings[0].error.what, HasSubstr("2 raw values"));
}

TEST(MapServer, AlphaMakesUnknownInOneDialectAndIsAveragedInTheOther) {
  // (0, alpha 128): unknown here; ROS averages: 64 -> p = 0.749 > 0.65: occupied.
  // (0, alpha 255): occupied here; ROS: 127.5 -> p = 0.5: unknown.
  const MapMetadata metadata{.image = "a"};
  const DecodedImage image = gray({0, 128, 0, 255, 255, 255}, 2);
  EXPECT_THAT(cells(image, metadata, MapDialect::kHypermap), ElementsAre(-1, 100, 0));
  EXPECT_THAT(cells(image, metadata, MapDialect::kMapServer), ElementsAre(100, -1, 0));
}

TEST(MapServer, ColoursSixteenBitAndOtherMaxvalsAreScaled) {
  const MapMetadata metadata{.image = "a"};
  EXPECT_THAT(cells(gray({0, 0, 30, 255, 255, 255}, 3), metadata, MapDialect::kHypermap),
              ElementsAre(100, 0));
  const DecodedImage wide{
      .width_px = 2, .height_px = 1, .bits = 16, .samples16 = {1000, 0}, .max_value = 1000};
  EXPECT_THAT(cells(wide, metadata, MapDialect::kHypermap), ElementsAre(0, 100));
}

TEST(MapServer, TheTopRowOfTheImageIsTheLastRowOfTheGrid) {
  const DecodedImage image{.width_px = 1, .height_px = 2, .samples8 = {0, 255}};
  EXPECT_THAT(cells(image, {.image = "a"}, MapDialect::kHypermap), ElementsAre(0, 100));
}

OccupancyLayer all_values() {
  std::vector<std::int8_t> values;
  for (int value = -1; value <= 100; ++value) values.push_back(static_cast<std::int8_t>(value));
  return OccupancyLayer(
      *OccupancyGrid::create(
          {.resolution_m = 0.1 / 3, .origin = {-0.1, 1e-7}, .yaw_rad = 0.3, .cols = 51, .rows = 2},
          std::move(values)),
      make_map({{"note", make_text("kept")}}));
}

TEST(MapServer, TheScaleFormKeepsEveryValueAtFullPrecision) {
  const OccupancyLayer layer = all_values();
  const auto files = write_scale_map(layer, "occupancy.png");
  ASSERT_TRUE(files);
  const auto metadata = parse_map_metadata(files->yaml, kMapSource);
  ASSERT_TRUE(metadata) << files->yaml;
  EXPECT_EQ(metadata->value.occupied_thresh, 1.0);
  EXPECT_EQ(metadata->value.free_thresh, 0.0);
  const auto image = decode_image(files->image, {.file = "occupancy.png"});
  const auto grid = grid_from_image(*image, metadata->value, MapDialect::kHypermap);
  EXPECT_EQ(grid->value, layer.grid);
  EXPECT_EQ(metadata->value.extra, layer.extra);
  EXPECT_EQ(write_scale_map(layer, "occupancy.png")->image, files->image);
  EXPECT_FALSE(write_scale_map({}, "x.png"));
}

TEST(MapServer, ThePixelsOfTheScaleFormAreTheFirstImplementations) {
  // formats.md: 100 -> (0, 255), 0 -> (255, 255), unknown -> (127, 0).
  const OccupancyLayer layer{
      *OccupancyGrid::create({.cols = 3, .rows = 1}, std::vector<std::int8_t>{100, 0, -1})};
  const auto image = decode_image(write_scale_map(layer, "x.png")->image, {.file = "x.png"});
  EXPECT_THAT(image->samples8, ElementsAre(0, 255, 255, 255, 127, 0));
}

TEST(MapServer, TheTrinaryFormReadsTheSameInBothDialectsAndWithNav2sThreshold) {
  const OccupancyLayer layer{
      *OccupancyGrid::create({.cols = 4, .rows = 1}, std::vector<std::int8_t>{100, 0, -1, 40})};
  const auto files = write_trinary_map(layer, "x.pgm");
  EXPECT_EQ(files->image, std::string("P5\n4 1\n255\n\0\xFE\xCD\xCD", 15));
  EXPECT_EQ(files->yaml,
            "image: x.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
            "free_thresh: 0.196\nmode: trinary\n");
  const auto metadata = parse_map_metadata(files->yaml, kMapSource);
  const auto image = decode_image(files->image, {.file = "x.pgm"});
  for (const MapDialect dialect : {MapDialect::kHypermap, MapDialect::kMapServer}) {
    EXPECT_THAT(cells(*image, metadata->value, dialect), ElementsAre(100, 0, -1, -1));
  }
}

TEST(MapServer, TheRawFormReadsTheSameInBothDialects) {
  const OccupancyLayer layer = all_values();
  const auto files = write_raw_map(layer, "x.pgm");
  const auto metadata = parse_map_metadata(files->yaml, kMapSource);
  EXPECT_EQ(metadata->value.mode, MapMode::kRaw);
  const auto image = decode_image(files->image, {.file = "x.pgm"});
  for (const MapDialect dialect : {MapDialect::kHypermap, MapDialect::kMapServer}) {
    EXPECT_EQ(grid_from_image(*image, metadata->value, dialect)->value, layer.grid);
  }
  EXPECT_TRUE(files->image.starts_with(std::string("P5\n51 2\n255\n\x32\x33", 14)))
      << "row 1 on top";
  EXPECT_FALSE(write_raw_map({}, "x.pgm"));
}

TEST(MapServer, AGridIsTurnedBackWithoutLosingWalls) {
  // A 2 x 1 grid turned by 90 degrees: cells (0, 0) and (1, 0) stand on x in [-1, 0], y 0..1, 1..2.
  const auto grid = OccupancyGrid::create(
      {.resolution_m = 1.0, .yaw_rad = std::numbers::pi / 2, .cols = 2, .rows = 1},
      std::vector<std::int8_t>{100, 0});
  const auto straight = without_rotation(*grid);
  ASSERT_TRUE(straight);
  EXPECT_EQ(straight->geometry().cols, 1);
  EXPECT_EQ(straight->geometry().rows, 2);
  EXPECT_EQ(straight->geometry().yaw_rad, 0.0);
  EXPECT_THAT(straight->cells(), ElementsAre(100, 0));
  const auto skew = OccupancyGrid::create(
      {.resolution_m = 1.0, .yaw_rad = 0.5, .cols = 9, .rows = 9}, std::int8_t{0});
  EXPECT_GT(without_rotation(*skew)->counts().unknown, 0U);  // corners that were never in the grid
  EXPECT_EQ(*without_rotation(*straight), *straight);
}

TEST(MapServer, AMapOnDiskNamesTheFileThatIsWrong) {
  const test::TempDir dir;
  std::ofstream(dir / "map.yaml") << kGood;
  EXPECT_THAT(to_string(read_map(dir / "map.yaml").error()), HasSubstr("a.pgm"));
  std::ofstream(dir / "a.pgm") << *encode_pgm(Image<std::uint8_t>(2, 3, 254));
  const auto map = read_map(dir / "map.yaml");
  ASSERT_TRUE(map) << to_string(map.error());
  EXPECT_EQ(map->value.grid.counts().free, 6U);
}

bool is_map_metadata(const std::string& name) {
  for (const char* part : {"layer", "config", "deep", "alias"}) {
    if (name.find(part) != std::string::npos) return false;
  }
  return true;
}

class HostileMapYaml : public ::testing::TestWithParam<std::string> {};

/// Files that are no map's metadata (configurations, bombs) must be refused_map here as well.
TEST_P(HostileMapYaml, GivesWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto path = test::shared_data("hostile/yaml") / GetParam();
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto metadata = parse_map_metadata(bytes, {.file = path.string()});
  if (GetParam().starts_with("ok_") && is_map_metadata(GetParam())) {
    EXPECT_TRUE(metadata) << to_string(metadata.error());
    return;
  }
  ASSERT_FALSE(metadata);
  EXPECT_THAT(to_string(metadata.error()), HasSubstr(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Corpus,
                         HostileMapYaml,
                         ::testing::ValuesIn(test::hostile_names("yaml")),
                         [](const auto& file) { return test::test_name_of(file.param); });

}  // namespace
}  // namespace hypermap
