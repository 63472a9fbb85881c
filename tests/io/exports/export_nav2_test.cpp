// SPDX-License-Identifier: BSD-3-Clause
// The bundle that `export_map` writes for Nav2; zone_masks_test.cpp holds its masks against shapes.
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

SemanticObject cell_sized(std::uint64_t id, const std::string& name, double x) {
  SemanticObject object;
  object.id = id;
  object.name = name;
  object.parts = {make_polygon({{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}).value()};
  return object;
}

/// A row of six free cells of a metre, but the last is unknown, and on it a person and a vase.
MapArchive row_of_cells(const std::string& frame_of_shapes = "map") {
  MapArchive archive;
  const GridGeometry geometry{.resolution_m = 1.0, .cols = 6, .rows = 1};
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy", .file = "occupancy"},
       .content = OccupancyLayer(
           OccupancyGrid::create(geometry, std::vector<std::int8_t>{0, 0, 0, 0, 0, -1}).value())}));
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .frame_id = frame_of_shapes, .file = "semantic"},
       .content = SemanticLayer::create({cell_sized(1, "person", 0.0), cell_sized(2, "vase", 4.0)})
                      .value()}));
  return archive;
}

ExportRequest bundle_request(const std::filesystem::path& output) {
  ExportRequest request;
  request.format = ExportFormat::kNav2;
  request.output = output;
  request.zones.of_class = {
      {"person", {.keepout_m = 0.5, .speed = SpeedZone{.percent = 30, .radius_m = 2.0}}},
      {"vase", {.keepout_m = 0.0, .speed = {}}}};
  return request;
}

std::vector<std::int8_t> cells_of(const std::filesystem::path& yaml) {
  const auto map = read_map(yaml);
  EXPECT_TRUE(map) << to_string(map.error());
  if (!map) return {};
  EXPECT_TRUE(map->findings.empty()) << yaml;
  return {map->value.grid.cells().begin(), map->value.grid.cells().end()};
}

TEST(ExportNav2, AMapServerReadsMapAndMasks) {
  const test::TempDir dir;
  const auto written = export_map(row_of_cells(), bundle_request(dir / "lab"));
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_EQ(written->size(), 9U);
  for (const auto& path : *written) EXPECT_TRUE(std::filesystem::exists(path)) << path;
  EXPECT_THAT(cells_of(dir / "lab/map.yaml"), ElementsAre(0, 0, 0, 0, 0, -1));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(100, 100, 0, 0, 100, 0));
  EXPECT_THAT(cells_of(dir / "lab/speed_mask.yaml"), ElementsAre(30, 30, 30, 0, 0, 0));
}

/// The parameter of a node in a parameter file, "" where there is none.
std::string parameter_of(const std::filesystem::path& file, const std::vector<std::string>& keys) {
  const auto document = read_yaml(file);
  EXPECT_TRUE(document) << to_string(document.error());
  if (!document) return "";
  YamlNode node = document->root();
  for (const std::string& key : keys) {
    const auto child = node.find(key);
    if (!child) return "";
    node = *child;
  }
  return node.value().text;
}

TEST(ExportNav2, ServersAndFiltersAgreeOnTopicsFilesAndTypes) {
  const test::TempDir dir;
  ASSERT_TRUE(export_map(row_of_cells(), bundle_request(dir / "lab")));
  const auto params = dir / "lab/nav2_params.yaml";
  for (const std::string name : {"keepout", "speed"}) {
    const auto info = dir / ("lab/" + name + "_filter_info.yaml");
    const std::string info_server = name + "_costmap_filter_info_server";
    const std::string mask_server = name + "_filter_mask_server";
    const auto of_info = [&](const std::string& key) {
      return parameter_of(info, {info_server, "ros__parameters", key});
    };
    const auto of_mask = [&](const std::string& key) {
      return parameter_of(info, {mask_server, "ros__parameters", key});
    };
    const auto of_plugin = [&](const std::string& key) {
      return parameter_of(
          params, {"global_costmap", "global_costmap", "ros__parameters", name + "_filter", key});
    };
    EXPECT_EQ(of_mask("yaml_filename"), name + "_mask.yaml");
    EXPECT_EQ(of_mask("frame_id"), "map");
    EXPECT_EQ(of_mask("topic_name"), of_info("mask_topic"));
    EXPECT_EQ(of_info("type"), name == "keepout" ? "0" : "1");
    EXPECT_EQ(of_info("base"), "0.0");
    EXPECT_EQ(of_info("multiplier"), "1.0");
    EXPECT_NE(of_info("filter_info_topic"), "");
    EXPECT_EQ(of_info("filter_info_topic"), of_plugin("filter_info_topic"));
    EXPECT_EQ(
        of_plugin("plugin"),
        name == "keepout" ? "nav2_costmap_2d::KeepoutFilter" : "nav2_costmap_2d::SpeedFilter");
  }
  const auto speed_topic = [&](const std::vector<std::string>& keys) {
    return parameter_of(params, keys);
  };
  EXPECT_EQ(speed_topic({"controller_server", "ros__parameters", "speed_limit_topic"}),
            speed_topic({"global_costmap",
                         "global_costmap",
                         "ros__parameters",
                         "speed_filter",
                         "speed_limit_topic"}));
}

TEST(ExportNav2, OnlyTheClassesThatAreAskedForMakeZones) {
  const test::TempDir dir;
  ExportRequest request = bundle_request(dir / "lab");
  request.classes = {"vase"};
  ASSERT_TRUE(export_map(row_of_cells(), request));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(0, 0, 0, 0, 100, 0));
  EXPECT_THAT(cells_of(dir / "lab/speed_mask.yaml"), Each(0));
  request.classes = {"unicorn"};
  EXPECT_EQ(export_map(row_of_cells(), request).error().code, ErrorCode::kNotFound);
}

TEST(ExportNav2, ShapesInAnotherFrameComeToTheGrid) {
  MapArchive archive = row_of_cells("lab");
  const test::TempDir dir;
  const auto unknown = export_map(archive, bundle_request(dir / "lab"));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(unknown.error().what, HasSubstr("lab"));
  EXPECT_FALSE(std::filesystem::exists(dir / "lab"));
  ASSERT_TRUE(archive.hypermap.frames().add(
      {.frame_id = "map", .child_frame_id = "lab", .x_m = 1.0, .y_m = 0.0, .yaw_rad = 0.0}));
  ASSERT_TRUE(export_map(archive, bundle_request(dir / "lab")));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(100, 100, 100, 0, 0, 100));
}

TEST(ExportNav2, WhatHangsAboveTheRobotClosesNothing) {
  MapArchive archive = row_of_cells();
  Object low;
  low.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.8}};
  archive.objects.add(low);  // 1: the person
  Object high;
  high.box = {{4.0, 0.0, 1.6}, {5.0, 1.0, 1.9}};
  archive.objects.add(high);  // 2: the vase
  const test::TempDir dir;
  ExportRequest request = bundle_request(dir / "lab");
  ASSERT_TRUE(export_map(archive, request));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(100, 100, 0, 0, 0, 0));
  request.zones.robot_height_m = 1.7;
  ASSERT_TRUE(export_map(archive, request)) << "replaces the older one";
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(100, 100, 0, 0, 100, 0));
}

TEST(ExportNav2, TheRobotStandsOnTheFloorOfTheMap) {
  MapArchive archive = row_of_cells();
  Object low;
  low.box = {{0.0, 0.0, 12.0}, {1.0, 1.0, 13.8}};
  archive.objects.add(low);  // 1: the person
  Object high;
  high.box = {{4.0, 0.0, 13.6}, {5.0, 1.0, 13.9}};
  archive.objects.add(high);  // 2: the vase
  archive.floor.height_m = 12.0;
  const test::TempDir dir;
  ASSERT_TRUE(export_map(archive, bundle_request(dir / "lab")));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), ElementsAre(100, 100, 0, 0, 0, 0));
}

TEST(ExportNav2, AMapWithoutShapesHasEmptyMasksAndOneWithoutAGridIsRefused) {
  MapArchive archive = row_of_cells();
  const test::TempDir dir;
  ASSERT_TRUE(archive.hypermap.remove_layer("semantic"));
  ASSERT_TRUE(export_map(archive, bundle_request(dir / "lab")));
  EXPECT_THAT(cells_of(dir / "lab/keepout_mask.yaml"), Each(0));
  ASSERT_TRUE(archive.hypermap.remove_layer("occupancy"));
  const auto without = export_map(archive, bundle_request(dir / "other"));
  ASSERT_FALSE(without);
  EXPECT_THAT(without.error().what, HasSubstr("--format nav2 needs a layer of kind"));
}

TEST(ExportNav2, SomebodysMapIsNotReplaced) {
  const test::TempDir dir;
  test::write_text(dir / "maps/map.yaml", "image: map.pgm\n");
  test::write_text(dir / "maps/map.pgm", "precious");
  const auto refused = export_map(row_of_cells(), bundle_request(dir / "maps"));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("is no whole Nav2 bundle: has 2 of its 9 files"));
  EXPECT_TRUE(std::filesystem::exists(dir / "maps/map.pgm"));
  ASSERT_TRUE(export_map(row_of_cells(), bundle_request(dir / "lab")));
  test::write_text(dir / "lab/notes.txt", "mine");
  EXPECT_THAT(export_map(row_of_cells(), bundle_request(dir / "lab")).error().what,
              HasSubstr("'notes.txt' in it is no file of a Nav2 bundle"));
}

TEST(ExportNav2, MasksAreNotTurned) {
  ExportRequest request = bundle_request("unused");
  request.keep_rotation = true;
  EXPECT_EQ(validate(request).error().field, "--keep-rotation");
}

}  // namespace
}  // namespace hypermap
