// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap_query.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return *make_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// A 3 x 2 grid of 1 m cells, and two cups and a chair in a room that is turned by 90 degrees and
/// lies at (10, 0) of the map.
Hypermap example() {
  Hypermap map;
  auto grid = OccupancyGrid::create({.resolution_m = 1.0, .cols = 3, .rows = 2},
                                    std::vector<std::int8_t>{0, 100, -1, 50, 0, 100});
  EXPECT_TRUE(map.add_layer({.info = {.name = "occupancy"}, .content = OccupancyLayer{*grid}}));
  auto semantic_layer = SemanticLayer::create(
      {{.id = 0, .name = "cup", .parts = {rectangle(0, 0, 1, 1)}},
       {.id = 1, .name = "chair", .parts = {rectangle(4, 0, 6, 1)}, .confidence = {0.7}},
       {.id = 2, .name = "cup", .parts = {rectangle(5, 0, 6, 2)}}});
  EXPECT_TRUE(
      map.add_layer({.info = {.name = "things", .frame_id = "room"}, .content = *semantic_layer}));
  EXPECT_TRUE(map.add_layer({.info = {.name = "odd"}, .content = OpaqueLayer{"Other"}}));
  EXPECT_TRUE(map.frames().add({"map", "room", 10, 0, std::numbers::pi / 2}));
  return map;
}

std::vector<std::string> names(const Result<std::vector<LayerAnswer>>& answers) {
  EXPECT_TRUE(answers) << (answers ? "" : to_string(answers.error()));
  std::vector<std::string> out;
  if (answers) {
    for (const LayerAnswer& answer : *answers) out.push_back(answer.name);
  }
  return out;
}

TEST(HypermapQuery, APointOnAGrid) {
  const Hypermap map = example();
  const auto answers = query_at(map, {"occupancy"}, {1.2, 0.9});
  ASSERT_TRUE(answers);
  ASSERT_EQ(answers->size(), 1U);
  EXPECT_EQ(answers->front().name, "Occupied");
  EXPECT_EQ(answers->front().value, 100);
  EXPECT_EQ(answers->front().id, 1U);
  EXPECT_EQ(answers->front().position, Eigen::Vector2d(1.5, 0.5));
  EXPECT_THAT(names(query_at(map, {"occupancy"}, {0.5, 1.5})), ElementsAre("Unknown"));  // 50
  EXPECT_THAT(names(query_at(map, {"occupancy"}, {-1, 0})), IsEmpty());
}

TEST(HypermapQuery, APointAmongObjects) {
  const Hypermap map = example();
  EXPECT_THAT(names(query_at(map, {"things"}, {5.5, 0.5})), ElementsAre("chair", "cup"));
  const auto chair = query_at(map, {"things"}, {4.5, 0.5});
  EXPECT_EQ(chair->front().confidence, 0.7);
  EXPECT_EQ(chair->front().value, 1);
}

TEST(HypermapQuery, AnyFrameMayBeAskedIn) {
  // The chair's centroid (5, 0.5) of the room is (10 - 0.5, 5) of the map.
  const Hypermap map = example();
  const auto answers = query_at(map, {"things", "map"}, {9.5, 4.5});
  ASSERT_EQ(names(answers), std::vector<std::string>{"chair"});
  EXPECT_TRUE(answers->front().position.isApprox(Eigen::Vector2d(9.5, 5), 1e-12));
  const auto cells = query_area(map, {"occupancy", "room"}, rectangle(0.1, 7.1, 0.9, 8.9));
  // Room (0.1..0.9, 7.1..8.9) is map (1.1..2.9, 0.1..0.9): cells 1 and 2 of row 0.
  ASSERT_EQ(names(cells), (std::vector<std::string>{"Occupied", "Unknown"}));
  EXPECT_TRUE(cells->front().position.isApprox(Eigen::Vector2d(0.5, 8.5), 1e-12));
}

TEST(HypermapQuery, AnArea) {
  const Hypermap map = example();
  EXPECT_THAT(names(query_area(map, {"things"}, rectangle(0.5, 0.5, 4.5, 0.6))),
              ElementsAre("cup", "chair"));
  EXPECT_THAT(names(query_area(map, {"occupancy"}, rectangle(0.5, 0.5, 1.5, 1.5))),
              ElementsAre("Free", "Occupied", "Unknown", "Free"));
}

TEST(HypermapQuery, AString) {
  const Hypermap map = example();
  const auto cups = query_string(map, {"things"}, "cup");
  ASSERT_EQ(cups->size(), 2U);
  EXPECT_EQ((*cups)[0].position, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ((*cups)[1].position, Eigen::Vector2d(5.5, 1));
  EXPECT_EQ(query_string(map, {"occupancy"}, "Occupied")->size(), 2U);
  EXPECT_EQ(query_string(map, {"occupancy"}, "Unknown")->size(), 2U);  // -1 and 50
  EXPECT_TRUE(query_string(map, {"things"}, "sink")->empty());
}

TEST(HypermapQuery, AStringInAnArea) {
  const Hypermap map = example();
  const auto cups = query_string(map, {"things"}, "cup", rectangle(3, -1, 9, 9));
  ASSERT_EQ(cups->size(), 1U);
  EXPECT_EQ(cups->front().id, 2U);
  EXPECT_EQ(query_string(map, {"occupancy"}, "Occupied", rectangle(0, 0, 2, 2))->size(), 1U);
}

TEST(HypermapQuery, AnIntegerAlsoInAnArea) {
  const Hypermap map = example();
  EXPECT_EQ(query_int(map, {"occupancy"}, 50)->front().position, Eigen::Vector2d(0.5, 1.5));
  EXPECT_EQ(query_int(map, {"occupancy"}, -1)->size(), 1U);
  EXPECT_EQ(query_int(map, {"occupancy"}, 100, rectangle(2, 1, 3, 2))->size(), 1U);
  EXPECT_THAT(names(query_int(map, {"things"}, 1)), ElementsAre("chair"));
  EXPECT_THAT(names(query_int(map, {"things"}, 1, rectangle(0, 0, 1, 1))), IsEmpty());
  EXPECT_THAT(names(query_int(map, {"things"}, -1)), IsEmpty());
}

TEST(HypermapQuery, WhatCannotBeAskedIsNamed) {
  const Hypermap map = example();
  EXPECT_EQ(query_at(map, {"nothing"}, {0, 0}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(query_at(map, {"things", "moon"}, {0, 0}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(query_at(map, {"odd"}, {0, 0}).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(query_at(map, {"things"}, {std::nan(""), 0}).error().field, "point");
  EXPECT_EQ(query_area(map, {"things"}, Polygon{}).error().field, "area");
}

TEST(HypermapQuery, NamesAreListedOnceInTheirOrder) {
  const Hypermap map = example();
  EXPECT_THAT(distinct_names(*query_area(map, {"things"}, rectangle(-1, -1, 9, 9))),
              ElementsAre("cup", "chair"));
}

// The room lies at (10, 0) of the map, turned by 90 degrees: its (0.2, 9.5) is (0.5, 0.2) there.
TEST(HypermapQuery, ASubMapOfAnAreaInAnyFrame) {
  const Hypermap map = example();
  const Layer& layer = **map.at("occupancy");
  const auto in_map = sub_map(layer, map.frames(), "", rectangle(0.2, 0.2, 1.5, 0.8));
  ASSERT_TRUE(in_map);
  EXPECT_THAT(in_map->grid.cells(), ElementsAre(0, 100));
  const auto in_room = sub_map(layer, map.frames(), "room", rectangle(0.2, 8.5, 0.8, 9.8));
  ASSERT_TRUE(in_room) << to_string(in_room.error());
  EXPECT_EQ(*in_room, *in_map);
  EXPECT_EQ(sub_map(layer, map.frames(), "cellar", rectangle(0, 0, 1, 1)).error().code,
            ErrorCode::kNotFound);
  EXPECT_EQ(sub_map(layer, map.frames(), "", rectangle(7, 7, 8, 8)).error().code,
            ErrorCode::kNotFound);
  EXPECT_EQ(sub_map(**map.at("things"), map.frames(), "", rectangle(0, 0, 1, 1)).error().code,
            ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace hypermap
