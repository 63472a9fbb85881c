// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/grid_stack_layer.hpp"

#include "archive_edits.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "projection/layers/layer_contract.hpp"
#include "projection/stack/grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::changed;
using test::load_error;
using test::member_of;
using test::replaced;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two layers on 3 x 2 cells, turned. Log-odds of a chair and of a cup in each cell, in steps:
///   (0, 0): 2197, 1386  (1, 0): -500, 0  (2, 0): 0, 0
///   (0, 1): -1, -13815  (1, 1): 0, 13815 (2, 1): -2197, 1
GridStack two_layers() {
  const GridGeometry geometry{
      .resolution_m = 0.1, .origin = {1.0 / 3.0, -2.0}, .yaw_rad = 0.3, .cols = 3, .rows = 2};
  GridStack::Layers layers;
  layers["/sensors/x/chair"] = LogOddsGrid::create(geometry, {2197, -500, 0, -1, 0, -2197}).value();
  layers["/sensors/cup"] = LogOddsGrid::create(geometry, {1386, 0, 0, -13815, 13815, 1}).value();
  return GridStack::create(geometry,
                           {.parent = "/sensors", .frame_id = "lab", .keep_share = 0.75},
                           std::move(layers))
      .value();
}

MapArchive archive_with_stack() {
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "stack", .frame_id = "lab"}, .content = GridStackLayer(two_layers())}));
  return archive;
}

TEST(GridStackLayer, KeepsTheContractOfLayers) {
  test::expect_layer_contract(GridStackLayer());
  test::expect_layer_contract(GridStackLayer(two_layers()));
}

TEST(GridStackLayer, ACellAnswersForEachLayerThatSaysYes) {
  const GridStackLayer layer(two_layers());
  const auto all = layer.query({}).value();
  std::vector<std::string> texts;
  texts.reserve(all.size());
  for (const LayerAnswer& answer : all)
    texts.push_back(std::to_string(answer.id) + " " + answer.name + " " +
                    std::to_string(answer.value));
  // Cups come first by name: ids 6 to 11, chairs 12 to 17. e^2.197 = 9, P = 0.9; e^1.386 = 4, 0.8.
  EXPECT_THAT(texts,
              ElementsAre("1 Free 0",
                          "2 Unknown -1",
                          "3 Free 0",
                          "6 cup 80",
                          "10 cup 100",
                          "11 cup 50",
                          "12 chair 90"));
  const auto at = layer.query({.at = PlanPoint{centre(two_layers().geometry(), {0, 0})}}).value();
  ASSERT_EQ(at.size(), 2U);
  EXPECT_NEAR(*at[1].confidence, 0.9, 1e-4);
  const auto cups = layer.query({.text = "Cup"}).value();
  EXPECT_EQ(cups.size(), 3U);
}

TEST(GridStackLayer, CountsCellsAsMaximumPoolingDoes) {
  const LayerStatistics statistics = GridStackLayer(two_layers()).statistics();
  EXPECT_EQ(statistics.cells->occupied, 3U);
  EXPECT_EQ(statistics.cells->free, 2U);
  EXPECT_EQ(statistics.cells->unknown, 1U);
  EXPECT_EQ(GridStackLayer().statistics().bounds, std::nullopt);
}

TEST(GridStackLayer, IsDrawnInTheColoursOfItsClasses) {
  const auto drawn = GridStackLayer(two_layers()).draw();
  ASSERT_EQ(drawn.size(), 1U);
  const auto& cells = std::get<DrawnCells>(drawn.front());
  const std::vector<Rgb8> expected{class_color("chair"),
                                   {235, 235, 235},
                                   {150, 150, 150},
                                   {235, 235, 235},
                                   class_color("cup"),
                                   class_color("cup")};
  EXPECT_EQ(cells.colors, expected);
}

TEST(GridStackLayer, IsSavedAndLoadedAsItIs) {
  const MapArchive archive = archive_with_stack();
  const std::string bytes = write_archive(archive).value();
  EXPECT_EQ(member_of(bytes, "stack.0").size(), 12U);
  EXPECT_EQ(member_of(bytes, "stack.1").substr(0, 4),
            std::string("\x95\x08\x0c\xfe"));  // 2197, -500
  const auto loaded = parse_archive(bytes, test::kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->findings.empty());
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  EXPECT_EQ(query_map(loaded->value, {.layer = "stack", .text = "chair"})->found.size(), 1U);
}

TEST(GridStackLayer, AnEmptyOneIsSavedAndLoadedToo) {
  MapArchive archive;
  ASSERT_TRUE(archive.hypermap.add_layer({.info = {.name = "none"}, .content = GridStackLayer()}));
  const std::string bytes = write_archive(archive).value();
  EXPECT_TRUE(parse_archive(bytes, test::kArchiveSource)->value == archive);
}

TEST(GridStackLayer, WithoutLayersItHasCellsThatNobodyKnows) {
  const GridStack stack = GridStack::create({.cols = 2, .rows = 1}).value();
  test::expect_layer_contract(GridStackLayer(stack));
  EXPECT_EQ(GridStackLayer(stack).statistics().cells->unknown, 2U);
}

TEST(GridStackLayer, WhatBreaksItIsNamed) {
  const std::string bytes = write_archive(archive_with_stack()).value();
  const std::string keys = member_of(bytes, "stack.yaml");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    return load_error(changed(bytes, {{"stack.yaml", replaced(keys, from, to)}}));
  };
  EXPECT_THAT(refusal("cols: 3", "cols: 4"), HasSubstr("12 bytes, its cells need 16"));
  EXPECT_THAT(refusal("cols: 3", "cols: 70000"), HasSubstr("stack.yaml"));
  EXPECT_THAT(refusal("resolution: 0.1", "resolution: .nan"), HasSubstr("resolution"));
  EXPECT_THAT(refusal("/sensors/cup", "/other/cup"), HasSubstr("below /sensors/"));
  EXPECT_THAT(refusal("/sensors/cup", "/sensors/x/chair"), HasSubstr("two layers"));
  EXPECT_THAT(refusal("max_log_odds: 13.815", "max_log_odds: 13.8"),
              HasSubstr("at most 13.8 either way"));
  EXPECT_THAT(refusal("keep_share: 0.75", "keep_share: 1.5"), HasSubstr("keep_share"));
  EXPECT_THAT(load_error(changed(bytes, {{"stack.1", ""}})), HasSubstr("stack.1"));
  EXPECT_THAT(load_error(changed(bytes, {{"stack.1", std::string(12, '\x7f')}})),
              HasSubstr("must be from -13.815 to 13.815"));
}

}  // namespace
}  // namespace hypermap
