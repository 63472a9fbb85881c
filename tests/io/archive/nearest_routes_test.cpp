// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/nearest_routes.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kRouteCellM = 0.1;

SemanticObject square_shape(std::uint64_t id, const std::string& name, double x, double y) {
  SemanticObject object;
  object.id = id;
  object.name = name;
  object.parts = {make_polygon({{x, y}, {x + 0.4, y}, {x + 0.4, y + 0.4}, {x, y + 0.4}}).value()};
  object.confidence = {0.9};
  return object;
}

void set_cells(OccupancyGrid& grid, const Rect& rect, std::int8_t value) {
  const auto cells = [](double m) { return static_cast<int>(std::lround(m / kRouteCellM)); };
  for (int row = cells(rect.min.y()); row < cells(rect.max.y()); ++row) {
    for (int col = cells(rect.min.x()); col < cells(rect.max.x()); ++col) {
      grid.set({col, row}, value);
    }
  }
}

/// A hall of 10 m by 6 m, with a wall at x = 5 from its lower edge to y = 5. Behind it stands chair
/// 1, 2 m from (4, 1); before it chair 2, 3 m away; stool 3 is in the middle of what nobody saw,
/// at x = 8 to 10, y = 4 to 6. A bed 4 is before the wall, too.
MapArchive walled_hall() {
  OccupancyGrid grid =
      OccupancyGrid::create({.resolution_m = kRouteCellM, .cols = 100, .rows = 60}, kFreeCell)
          .value();
  set_cells(grid, {{5, 0}, {5.2, 5}}, kOccupiedCell);
  set_cells(grid, {{6, 0.8}, {6.4, 1.2}}, kOccupiedCell);
  set_cells(grid, {{0.6, 0.8}, {1, 1.2}}, kOccupiedCell);
  set_cells(grid, {{8, 4}, {10, 6}}, kUnknownCell);
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy", .file = "occupancy"}, .content = OccupancyLayer(grid)}));
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .file = "semantic"},
       .content = SemanticLayer::create({square_shape(1, "chair", 6, 0.8),
                                         square_shape(2, "chair", 0.6, 0.8),
                                         square_shape(3, "stool", 9, 5),
                                         square_shape(4, "bed", 2, 3)})
                      .value()}));
  for (const char* name : {"chair", "stool", "bed", "table"}) {
    EXPECT_TRUE(archive.classes.add(name));
  }
  return archive;
}

MapQuery asking(const std::string& name, double x, double y) {
  return {.text = name, .at = PlanPoint{{x, y}}};
}

std::string refusal_of(const MapArchive& archive,
                       const MapQuery& query,
                       const ApproachOptions& options = {}) {
  const auto reached = query_nearest_routes(archive, query, options);
  if (reached) return "";
  return reached.error().field + ": " + reached.error().what;
}

TEST(NearestRoutes, TheChairBeforeTheWallIsNearerThanTheOneBehindIt) {
  const MapArchive archive = walled_hall();
  const MapQuery query = asking("Chair", 4, 1);
  const ReachedObjects one = query_nearest_routes(archive, query).value();
  EXPECT_EQ(one.frame_id, "map");
  EXPECT_THAT(one.out_of_reach, IsEmpty());
  ASSERT_THAT(one.found, SizeIs(1));
  EXPECT_EQ(one.found[0].object.id, 2U);
  EXPECT_EQ(one.found[0].object.name, "chair");
  EXPECT_EQ(one.found[0].object.confidence, 0.9);
  EXPECT_NEAR(one.found[0].straight_m, 3.0, 1e-12);
  // The robot stands 0.25 m from the chair, or up to 0.2 m farther, by cells of 0.1 m: the way goes
  // straight to there.
  EXPECT_NEAR(one.found[0].route.length_m + one.found[0].gap_m, 3.0, 0.05);
  EXPECT_GE(one.found[0].gap_m, 0.25);
  EXPECT_LE(one.found[0].gap_m, 0.5);
  const ReachedObjects both = query_nearest_routes(archive, query, {}, 5).value();
  ASSERT_THAT(both.found, SizeIs(2));
  EXPECT_EQ(both.found[1].object.id, 1U);
  EXPECT_NEAR(both.found[1].straight_m, 2.0, 1e-12);
  // Up to the wall's end and down again: more than 4 m each.
  EXPECT_GT(both.found[1].route.length_m, 8.0);
}

TEST(NearestRoutes, EachReasonWhyThereIsNoneIsSaid) {
  const MapArchive archive = walled_hall();
  EXPECT_THAT(refusal_of(archive, asking("chair", 5.1, 1)), HasSubstr("at: is in an obstacle"));
  EXPECT_THAT(refusal_of(archive, asking("chair", 9, 5)), HasSubstr("at: is in unknown space"));
  EXPECT_THAT(refusal_of(archive, asking("chair", 10, 5)),
              HasSubstr("at: is outside the occupancy grid"));
  EXPECT_THAT(refusal_of(archive, asking("chair", 4.9, 1)),
              HasSubstr("nearer than the robot's radius of 0.25 m"));
  EXPECT_THAT(refusal_of(archive, asking("chairs", 4, 1)),
              HasSubstr("no object of class 'chairs'"));
  EXPECT_THAT(refusal_of(archive, asking("table", 4, 1)), HasSubstr("no object of class 'table'"));
  // Stool 3 is 1 m into unknown space: one arm is too short, another long enough.
  EXPECT_THAT(refusal_of(archive, asking("stool", 4, 1)),
              HasSubstr("no free place for a robot of radius 0.25 m has one of 1 object of class "
                        "'stool' within 0.5 m of its rim"));
  EXPECT_EQ(refusal_of(archive, asking("stool", 4, 1), {.reach_m = 0.9}), "");
  // Between the wall's end and the hall's edge lies 1 m.
  EXPECT_EQ(refusal_of(archive, {.value = 1, .at = PlanPoint{{4, 1}}}, {.robot_radius_m = 0.4}),
            "");
  EXPECT_THAT(refusal_of(archive, {.value = 1, .at = PlanPoint{{4, 1}}}, {.robot_radius_m = 0.6}),
              HasSubstr("no free way leads a robot of radius 0.6 m to one of 1 object with id 1"));
  EXPECT_THAT(refusal_of(MapArchive{}, asking("chair", 4, 1)),
              HasSubstr("occupancy: the map has no occupancy grid"));
  MapArchive without_shapes = archive;
  without_shapes.hypermap.remove_layer("semantic");
  EXPECT_THAT(refusal_of(without_shapes, asking("chair", 4, 1)),
              HasSubstr("semantic: the map has no semantic layer"));
}

TEST(NearestRoutes, AQuestionThatCannotBeAskedIsRefusedByName) {
  const MapArchive archive = walled_hall();
  const auto code_of = [&](const MapQuery& query, const ApproachOptions& options = {}) {
    return query_nearest_routes(archive, query, options).error().code;
  };
  EXPECT_EQ(code_of({.text = "chair"}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({.text = "chair", .at = PlanPoint{{4, 1}, 0.5}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of(asking("chair", 4, 1), {.robot_radius_m = -1}), ErrorCode::kInvalidArgument);
  MapQuery elsewhere = asking("chair", 4, 1);
  elsewhere.frame_id = "moon";
  EXPECT_EQ(code_of(elsewhere), ErrorCode::kNotFound);
}

TEST(NearestRoutes, NamesAreAskedAsEverywhereAndConditionsCombine) {
  MapArchive archive = walled_hall();
  EXPECT_EQ(
      query_nearest_routes(archive, asking("/chair|bed/", 4, 3)).value().found.at(0).object.id, 4U);
  EXPECT_EQ(query_nearest_routes(archive, asking("ch*", 4, 3)).value().found.at(0).object.id, 2U);
  MapQuery behind = asking("chair", 4, 1);
  behind.area = make_polygon({{5, 0}, {10, 0}, {10, 6}, {5, 6}}).value();
  EXPECT_EQ(query_nearest_routes(archive, behind).value().found.at(0).object.id, 1U);
  MapQuery by_id = asking("chair", 4, 1);
  by_id.value = 1;
  EXPECT_EQ(query_nearest_routes(archive, by_id).value().found.at(0).object.id, 1U);
}

// The frame `room` has its origin at (1, 2) of the map and is turned by a quarter: (x, y) of it is
// (1 - y, 2 + x) of the map.
TEST(NearestRoutes, PointsAreInTheFrameThatIsAskedIn) {
  MapArchive archive = walled_hall();
  ASSERT_TRUE(archive.hypermap.frames().add({.frame_id = "map",
                                             .child_frame_id = "room",
                                             .x_m = 1.0,
                                             .y_m = 2.0,
                                             .yaw_rad = std::acos(0.0)}));
  const auto in_map = query_nearest_routes(archive, asking("chair", 4.03, 1.04)).value();
  MapQuery query = asking("chair", -0.96, -3.03);
  query.frame_id = "room";
  const auto in_room = query_nearest_routes(archive, query).value();
  EXPECT_EQ(in_room.frame_id, "room");
  ASSERT_THAT(in_room.found, SizeIs(1));
  const auto& points = in_room.found[0].route.points;
  const auto& expected = in_map.found.at(0).route.points;
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(1.0 - points[i].y(), expected[i].x(), 1e-9);
    EXPECT_NEAR(2.0 + points[i].x(), expected[i].y(), 1e-9);
  }
  EXPECT_NEAR(in_room.found[0].route.length_m, in_map.found[0].route.length_m, 1e-9);
}

TEST(NearestRoutes, WhatStandsWhereNobodyCanGoIsTold) {
  MapArchive archive = walled_hall();
  const auto reached = query_nearest_routes(archive, asking("/stool|bed/", 4, 1)).value();
  EXPECT_THAT(reached.out_of_reach, ElementsAre(3U));
  ASSERT_THAT(reached.found, SizeIs(1));
  EXPECT_EQ(reached.found[0].object.id, 4U);
}

}  // namespace
}  // namespace hypermap
