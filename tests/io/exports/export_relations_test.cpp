// SPDX-License-Identifier: BSD-3-Clause
// What `export_map` writes of relations.
#include "core/places/furniture.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

class ExportRelations : public testing::Test {
 protected:
  ExportRelations() {
    FurnishedRoom room;
    room.add_box("dining \"table\"", standing(0, 0, 0, {1.2, 0.8, 0.75}));
    room.add_box("cup", standing(0.25, 0, 0.75, {0.125, 0.125, 0.125}));
    room.add_box("cup", standing(0.5, 0, 0.75, {0.125, 0.125, 0.125}));
    archive_.objects = std::move(room.objects);
    archive_.classes = std::move(room.classes);
  }

  Result<std::string> exported(const std::string& name, std::vector<std::string> classes = {}) {
    ExportRequest request;
    request.format = ExportFormat::kRelations;
    request.output = dir_ / name;
    request.classes = std::move(classes);
    const auto written = export_map(archive_, request);
    if (!written) return Unexpected(written.error());
    if (written->empty()) return std::string();
    std::ostringstream text;
    text << std::ifstream(written->front()).rdbuf();
    return text.str();
  }

  MapArchive archive_;
  test::TempDir dir_;
};

TEST_F(ExportRelations, AHandWorkedGraphAsDot) {
  EXPECT_EQ(exported("a.dot").value(),
            "digraph relations {\n"
            "  rankdir=BT;\n"
            "  1 [label=\"dining \\\"table\\\" 1\", pos=\"0,0!\"];\n"
            "  2 [label=\"cup 2\", pos=\"0.25,0!\"];\n"
            "  3 [label=\"cup 3\", pos=\"0.5,0!\"];\n"
            "  floor [shape=box];\n"
            "  1 -> floor [label=\"on\"];\n"
            "  2 -> 1 [label=\"on\", plan_share=1, gap_m=0, contact_height_m=0.75, "
            "contact_share=1];\n"
            "  3 -> 1 [label=\"on\", plan_share=1, gap_m=0, contact_height_m=0.75, "
            "contact_share=1];\n"
            "  2 -> 3 [label=\"beside\", dir=none, style=dashed, constraint=false, "
            "gap_m=0.125];\n"
            "}\n");
}

TEST_F(ExportRelations, ThatGraphAsGeojson) {
  const auto json = nlohmann::json::parse(exported("a.local.geojson").value());
  ASSERT_EQ(json["features"].size(), 6U);
  EXPECT_EQ(json["features"][1]["properties"]["sentence"],
            "cup 2 is on dining \"table\" 1, beside cup 3");
  EXPECT_EQ(json["features"][1]["properties"]["supported_by"], 1);
  const auto& on = json["features"][3];
  EXPECT_EQ(on["geometry"]["type"], "LineString");
  EXPECT_EQ(on["properties"]["relation"], "on");
  EXPECT_EQ(on["properties"]["source"], "boxes");
}

TEST_F(ExportRelations, OnlyOfTheClassesAskedFor) {
  FurnishedRoom room;
  room.add_box("table", standing(0, 0, 0, {1.2, 0.8, 0.75}));
  room.add_box("cup", standing(0.25, 0, 0.75, {0.125, 0.125, 0.125}));
  room.add_box("chair", standing(5, 0, 0, {0.5, 0.5, 0.9}));
  archive_.objects = std::move(room.objects);
  archive_.classes = std::move(room.classes);
  const std::string cups = exported("a.dot", {"cup"}).value();
  EXPECT_THAT(cups, HasSubstr("table 1")) << "what a cup stands on is at the end of its relation";
  EXPECT_THAT(cups, HasSubstr("2 -> 1"));
  EXPECT_THAT(cups, Not(HasSubstr("chair")));
  EXPECT_THAT(exported("a.dot", {"chair"}).value(), Not(HasSubstr("table")));
  EXPECT_EQ(exported("a.dot", {"cap"}).error().code, ErrorCode::kNotFound);
}

TEST_F(ExportRelations, OtherNamesAreRefusedAndNothingIsNoFile) {
  EXPECT_EQ(exported("a.geojson").error().field, "--output");
  EXPECT_FALSE(std::filesystem::exists(dir_ / "a.geojson"));
  archive_ = MapArchive();
  EXPECT_THAT(exported("a.dot").value(), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(dir_ / "a.dot"));
}

TEST_F(ExportRelations, FootprintsOfObjectsHaveTheirRelations) {
  std::vector<SemanticObject> shapes;
  for (const Object& object : archive_.objects.objects()) {
    const Box& box = object.box;
    const Eigen::Vector2d low = box.min_in_map.head<2>();
    const Eigen::Vector2d high = box.max_in_map.head<2>();
    shapes.push_back(
        {.id = object.id.value,
         .name = "shape",
         .parts = {make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}).value()}});
  }
  ASSERT_TRUE(archive_.hypermap.add_layer(
      {LayerInfo{.name = "semantic"}, SemanticLayer::create(std::move(shapes)).value()}));
  ExportRequest request;
  request.format = ExportFormat::kGeojson;
  request.output = dir_ / "shapes.local.geojson";
  ASSERT_TRUE(export_map(archive_, request));
  const auto json = nlohmann::json::parse(std::ifstream(dir_ / "shapes.local.geojson"));
  const auto& cup = json["features"][1]["properties"];
  EXPECT_EQ(cup["support"], "object");
  EXPECT_THAT(cup["on"].get<std::vector<int>>(), ElementsAre(1));
  EXPECT_THAT(cup["beside"].get<std::vector<int>>(), ElementsAre(3));
  EXPECT_EQ(json["features"][0]["properties"]["support"], "floor");
}

}  // namespace
}  // namespace hypermap
