// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/supercell_layer.hpp"

#include "archive_edits.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "projection/layers/layer_contract.hpp"
#include "projection/supercells/stack_builders.hpp"

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

const GridGeometry kGeometry = test::cells_of(4, 2);  // cells of 0.1 m

/// Row 0 below:   0 2 2 1   Layer "0" says 0.8 of supercell 0, 0.2 of the others; layer "1" is
///                0 0 1 1   unknown but of supercell 2, where it says 0.4.
SupercellLayer three_supercells() {
  const std::vector<std::int32_t> labels{0, 0, 1, 1, 0, 2, 2, 1};
  const GridStack stack = test::stack_from(kGeometry, 2, [&](int layer, Cell cell) {
    const std::int32_t label = labels[kGeometry.index(cell)];
    if (layer == 0) return label == 0 ? 0.8 : 0.2;
    return label == 2 ? 0.4 : 0.5;
  });
  Supercells supercells{.geometry = kGeometry,
                        .labels = labels,
                        .count = 3,
                        .first_energy = 0.75,
                        .energy = 1.0 / 3.0,
                        .num_moves = 7};
  TopometricGraph graph = topometric_graph(stack, supercells).value();
  return SupercellLayer::create(std::move(supercells), std::move(graph)).value();
}

MapArchive archive_with_supercells() {
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "cells", .frame_id = "map"}, .content = three_supercells()}));
  return archive;
}

TEST(SupercellLayer, KeepsTheContractOfLayers) {
  test::expect_layer_contract(SupercellLayer());
  test::expect_layer_contract(three_supercells());
}

TEST(SupercellLayer, ASupercellAnswersWhereOneOfItsCellsIs) {
  const SupercellLayer layer = three_supercells();
  const auto all = layer.query({}).value();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].name, "0");  // the last part of /ism/0
  EXPECT_NEAR(*all[0].confidence, 0.8, 1e-3);
  EXPECT_EQ(all[1].name, "Free");
  EXPECT_EQ(all[1].confidence, std::nullopt);
  EXPECT_EQ(all[2].value, 2);
  // The centroid of supercell 0 is (0.083, 0.083): its nearest cell's centre is (0.05, 0.05).
  EXPECT_TRUE(all[0].position.isApprox(Eigen::Vector2d(0.05, 0.05), 1e-9));
  EXPECT_EQ(layer.query({.at = PlanPoint{{0.15, 0.15}}}).value().front().id, 2U);
  EXPECT_THAT(test::ids_of(layer, {.area = test::rectangle({0.12, 0.12}, {0.39, 0.18})}),
              ElementsAre(1, 2));
}

TEST(SupercellLayer, DrawsItsGraphOverItsCells) {
  const auto drawn = three_supercells().draw();
  ASSERT_EQ(drawn.size(), 4U);  // cells, and each of three pairs touches
  const auto& cells = std::get<DrawnCells>(drawn.front());
  EXPECT_EQ(cells.colors[0], class_color("0"));
  EXPECT_EQ(cells.colors[3], (Rgb8{235, 235, 235}));
  const auto& line = std::get<DrawnLine>(drawn[1]);
  EXPECT_TRUE(line.points[0].isApprox(Eigen::Vector2d(0.25 / 3, 0.25 / 3), 1e-9));
}

TEST(SupercellLayer, IsSavedAndLoadedAsItIs) {
  const MapArchive archive = archive_with_supercells();
  const std::string bytes = write_archive(archive).value();
  EXPECT_EQ(member_of(bytes, "cells.labels").size(), 32U);
  const auto loaded = parse_archive(bytes, test::kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->findings.empty());
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  const auto* layer = loaded->value.hypermap.find_as<SupercellLayer>("cells");
  const auto way = shortest_path(layer->graph(), 0, 1);
  EXPECT_THAT(way->nodes, ElementsAre(0, 1));
}

TEST(SupercellLayer, AnEmptyOneIsSavedAndLoadedToo) {
  MapArchive archive;
  ASSERT_TRUE(archive.hypermap.add_layer({.info = {.name = "none"}, .content = SupercellLayer()}));
  const std::string bytes = write_archive(archive).value();
  EXPECT_TRUE(parse_archive(bytes, test::kArchiveSource)->value == archive);
}

TEST(SupercellLayer, WhatBreaksItIsNamed) {
  const std::string bytes = write_archive(archive_with_supercells()).value();
  const std::string keys = member_of(bytes, "cells.yaml");
  const std::string lines = member_of(bytes, "cells.jsonl");
  const auto of_keys = [&](const std::string& from, const std::string& to) {
    return load_error(changed(bytes, {{"cells.yaml", replaced(keys, from, to)}}));
  };
  EXPECT_THAT(of_keys("supercells: 3", "supercells: 4"), HasSubstr("line for each of 4"));
  EXPECT_THAT(of_keys("supercells: 3", "supercells: 2"), HasSubstr("has more"));
  EXPECT_THAT(of_keys("supercells: 3", "supercells: 9"), HasSubstr("supercells"));
  EXPECT_THAT(of_keys("cols: 4", "cols: 3"), HasSubstr("32 bytes, its cells need 24"));
  EXPECT_THAT(of_keys("/ism/1", "/ism/0, /ism/1"), HasSubstr("each of 3 layers"));
  const auto of_lines = [&](const std::string& from, const std::string& to) {
    return load_error(changed(bytes, {{"cells.jsonl", replaced(lines, from, to)}}));
  };
  EXPECT_THAT(of_lines("[1,2]", "[2,1]"), HasSubstr("ascend"));
  EXPECT_THAT(of_lines("[1,2]", "[1]"), HasSubstr("which has not it"));
  EXPECT_THAT(of_lines("[1,2]", "[1,3]"), HasSubstr("neighbour 3"));
  EXPECT_THAT(of_lines("[1,2]", "[-1,1,2]"), HasSubstr("neighbour -1"));
  EXPECT_THAT(of_lines("\"cells\":3", "\"cells\":4"), HasSubstr("says 4 cells, there are 3"));
  EXPECT_THAT(of_lines("\"mean\"", "\"meen\""), HasSubstr("cells.jsonl"));
  EXPECT_THAT(load_error(changed(bytes, {{"cells.jsonl", lines.substr(0, lines.size() - 2)}})),
              HasSubstr("cells.jsonl"));
  std::string labels = member_of(bytes, "cells.labels");
  labels[0] = 3;
  EXPECT_THAT(load_error(changed(bytes, {{"cells.labels", labels}})), HasSubstr("label 3"));
}

}  // namespace
}  // namespace hypermap
