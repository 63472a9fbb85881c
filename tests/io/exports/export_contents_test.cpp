// SPDX-License-Identifier: BSD-3-Clause
// What stands in single formats, what of a map is asked for, and exports that would be empty.
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result<std::vector<std::filesystem::path>> export_as(const MapArchive& archive,
                                                     ExportFormat format,
                                                     const std::filesystem::path& output) {
  return export_map(archive, {.format = format, .output = output, .layer = {}, .classes = {}});
}

class EmptyExport : public testing::TestWithParam<std::pair<ExportFormat, const char*>> {};

// "zebra" is a class that the map knows and has nothing of.
TEST_P(EmptyExport, WritesNothing) {
  MapArchive archive = test::sample_archive();
  ASSERT_TRUE(archive.classes.add("zebra"));
  const test::TempDir dir;
  const auto written = export_map(archive,
                                  {.format = GetParam().first,
                                   .output = dir / GetParam().second,
                                   .layer = {},
                                   .classes = {"Zebra"}});
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_TRUE(written->empty());
  EXPECT_FALSE(std::filesystem::exists(dir / GetParam().second) &&
               !std::filesystem::is_directory(dir / GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         EmptyExport,
                         testing::Values(std::pair(ExportFormat::kClassGrids, "grids"),
                                         std::pair(ExportFormat::kOctomap, "a.ot"),
                                         std::pair(ExportFormat::kColorOctomap, "a.ot"),
                                         std::pair(ExportFormat::kPly, "a.ply"),
                                         std::pair(ExportFormat::kGlb, "a.glb"),
                                         std::pair(ExportFormat::kGeojson, "a.local.geojson")));

TEST(EmptyExports, AMapWithoutKnownCellsIsNone) {
  const GridGeometry geometry{.resolution_m = 0.05, .cols = 1, .rows = 1};
  MapArchive archive;
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "map", .file = "map"},
       .content = OccupancyLayer(OccupancyGrid::create(geometry, std::int8_t{-1}).value())}));
  const test::TempDir dir;
  const auto written = export_as(archive, ExportFormat::kRosMap, dir / "lab");
  ASSERT_TRUE(written);
  EXPECT_TRUE(written->empty());
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(ExportNames, AreTakenInAnySpelling) {
  EXPECT_EQ(parse_export_format("ROS_Map").value(), ExportFormat::kRosMap);
  EXPECT_EQ(parse_export_format("geopackage").value(), ExportFormat::kGeopackage);
  EXPECT_EQ(parse_export_format("gpkg").value(), ExportFormat::kGeopackage);
  EXPECT_EQ(parse_export_format("dot").value(), ExportFormat::kTopologicalMap);
  EXPECT_THAT(parse_export_format("ros-mpa").error().what, HasSubstr("did you mean \"ros-map\""));
  const MapArchive archive = test::sample_archive();
  const test::TempDir dir;
  ExportRequest request{.format = ExportFormat::kGeojson,
                        .output = dir / "a.local.geojson",
                        .layer = "Semantic",
                        .classes = {}};
  EXPECT_TRUE(export_map(archive, request));
  request.layer = "Chair";
  const auto refused = export_map(archive, request);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("chair is a class: --class \"chair\""));
}

TEST(ExportNames, AClassAsLayerOfARosMapLeadsToItsGrid) {
  MapArchive archive = test::sample_archive();
  archive.class_grids.clear();
  const test::TempDir dir;
  const ExportRequest request{
      .format = ExportFormat::kRosMap, .output = dir / "a", .layer = "Chair", .classes = {}};
  const auto without = export_map(archive, request);
  ASSERT_FALSE(without);
  EXPECT_THAT(without.error().what, HasSubstr("(there are: occupancy, semantic)"));
  EXPECT_THAT(without.error().what, HasSubstr("chair is a class of which the map has no grid"));
  archive.class_grids.push_back({.class_name = "chair", .grid = test::sample_grid(100)});
  const auto with = export_map(archive, request);
  ASSERT_FALSE(with);
  EXPECT_THAT(with.error().what, HasSubstr("--format class-grids --class \"chair\""));
  const ExportRequest helped{.format = ExportFormat::kClassGrids,
                             .output = dir / "grids",
                             .layer = {},
                             .classes = {"chair"}};
  EXPECT_EQ(export_map(archive, helped).value().size(), 3U);
}

TEST(ExportNames, WhatAFormatDoesNotHaveIsRefused) {
  const MapArchive archive = test::sample_archive();
  const test::TempDir dir;
  const auto refused = [&](const ExportRequest& request) {
    return export_map(archive, request).error().field;
  };
  EXPECT_EQ(refused({.format = ExportFormat::kPly,
                     .output = dir / "a.ply",
                     .layer = "semantic",
                     .classes = {}}),
            "--layer");
  EXPECT_EQ(refused({.format = ExportFormat::kRosMap,
                     .output = dir / "a",
                     .layer = {},
                     .classes = {"chair"}}),
            "--class");
  EXPECT_EQ(
      refused({.format = ExportFormat::kPly, .output = dir / "a.jpg", .layer = {}, .classes = {}}),
      "--output");
}

TEST(ExportNames, ALayerOfAnotherKindIsToldWithTheKindThatIsNeeded) {
  MapArchive archive = test::sample_archive();
  const test::TempDir dir;
  const auto other = export_map(
      archive,
      {.format = ExportFormat::kRosMap, .output = dir / "a", .layer = "semantic", .classes = {}});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().field, "--layer");
  EXPECT_EQ(other.error().what,
            "--format ros-map needs a layer of kind OccupancyGridLayer, 'semantic' is a "
            "SemanticLayer");
  archive.hypermap.remove_layer("occupancy");
  const auto none = export_as(archive, ExportFormat::kRosMap, dir / "a");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(none.error().what,
            "--format ros-map needs a layer of kind OccupancyGridLayer, the map has none");
}

TEST(ExportPly, HasTheTypesAndNamesThatOthersRead) {
  const test::TempDir dir;
  ASSERT_TRUE(export_as(test::sample_archive(), ExportFormat::kPly, dir / "a.ply"));
  EXPECT_THAT(read_file(dir / "a.ply", 1U << 20U).value(),
              HasSubstr("property uint16 scalar_label\nproperty int scalar_instance\n"
                        "property float scalar_confidence\nend_header\n"));
}

TEST(ExportPly, AClassNameStaysInItsComment) {
  MapArchive archive;
  ASSERT_TRUE(archive.classes.add("chair\nend_header"));
  archive.octree = test::sample_octree();
  const test::TempDir dir;
  ASSERT_TRUE(export_as(archive, ExportFormat::kPly, dir / "a.ply"));
  const std::string ply = read_file(dir / "a.ply", 1U << 20U).value();
  EXPECT_THAT(ply, HasSubstr("comment label 0 chair\\x0aend_header\n"));
  EXPECT_THAT(ply, Not(HasSubstr("chair\nend_header")));
}

// Object 1 of the map is 0.1 x 0.2 x 0.3 m, from the origin up.
TEST(ExportGeojson, AShapeHasTheSizeOfItsObject) {
  MapArchive archive = test::sample_archive();
  archive.hypermap.remove_layer("semantic");
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .file = "semantic"},
       .content = SemanticLayer::create(
                      {test::sample_shape(1, "chair", 0.0), test::sample_shape(9, "cup", 2.0)})
                      .value()}));
  const test::TempDir dir;
  const auto path = dir / "a.local.geojson";
  ASSERT_TRUE(export_as(archive, ExportFormat::kGeojson, path));
  const auto features = nlohmann::json::parse(read_file(path, 1U << 20U).value()).at("features");
  EXPECT_EQ(features.at(0).at("properties").at("size_m"), nlohmann::json({0.1, 0.2, 0.3}));
  EXPECT_EQ(features.at(0).at("properties").at("height_m"), 0.3);
  EXPECT_EQ(features.at(0).at("bbox"), nlohmann::json({0.0, 0.0, 0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(features.at(0).at("properties").at("seen_share"), 0.0);  // it has no detection
  EXPECT_FALSE(features.at(1).contains("bbox"));
}

// The backs of chairs are 0.1 m thick, whole chairs 0.4 m; of object 3 the back was seen.
TEST(ExportGeojson, AGuessIsThereOnRequestAndSaysSo) {
  MapArchive archive;
  ASSERT_TRUE(archive.classes.add("chair"));
  for (const double depth_m : {0.4, 0.4, 0.1}) {
    Object object;
    object.box = {{0.0, 0.0, 0.0}, {depth_m, 0.5, 0.8}};
    for (const float bearing_rad : {3.0F, 1.6F, 4.7F, 0.0F}) {
      object.observation_log.add({.bearing_rad = bearing_rad});
      if (depth_m < 0.2) break;  // from the west alone
    }
    archive.objects.add(object);
  }
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .file = "semantic"},
       .content = SemanticLayer::create({test::sample_shape(1, "chair", 0.0),
                                         test::sample_shape(2, "chair", 1.0),
                                         test::sample_shape(3, "chair", 2.0)})
                      .value()}));
  const test::TempDir dir;
  const auto properties = [&](bool complete) {
    const auto path = dir / "a.local.geojson";
    ExportRequest request{
        .format = ExportFormat::kGeojson, .output = path, .layer = {}, .classes = {}};
    request.complete = complete;
    EXPECT_TRUE(export_map(archive, request));
    return nlohmann::json::parse(read_file(path, 1U << 20U).value())
        .at("features")
        .at(2)
        .at("properties");
  };
  EXPECT_NEAR(properties(false).at("seen_share").get<double>(), 0.5 / 1.2, 1e-12);
  EXPECT_FALSE(properties(false).contains("completed_box"));
  const auto guess = properties(true).at("completed_box");
  EXPECT_EQ(guess.at("guess"), true);
  EXPECT_EQ(guess.at("bbox"), nlohmann::json({0.0, 0.0, 0.0, 0.4, 0.5, 0.8}));
}

TEST(ExportGeojson, ANameIsOneText) {
  MapArchive archive = test::sample_archive();
  ASSERT_TRUE(archive.hypermap.set_content(
      "semantic",
      SemanticLayer::create(
          {test::sample_shape(0, std::string("../../etc/passwd\n- evil: true"), 0.0)})
          .value()));
  const test::TempDir dir;
  const auto path = dir / "a.local.geojson";
  ASSERT_TRUE(export_as(archive, ExportFormat::kGeojson, path));
  EXPECT_THAT(read_file(path, 1U << 20U).value(),
              HasSubstr(R"("name": "../../etc/passwd\n- evil: true")"));
}

}  // namespace
}  // namespace hypermap
