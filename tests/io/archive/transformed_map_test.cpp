// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/transformed_map.hpp"

#include "hypermap/core/geometry/block_looks.hpp"
#include "sample_archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr double kQuarterTurnRad = 0.5 * std::numbers::pi;
constexpr double kBinRad = std::numbers::pi / 9.0;
constexpr double kRoundingM = 1e-9;

MapFromOldMap moved_by(const Eigen::Vector3d& shift_m, double yaw_rad) {
  return MapFromOldMap(Eigen::Translation3d(shift_m) *
                       Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

ObservationLogEntry detection_at(float bearing_rad) {
  return {.detector = DetectorId{1}, .class_id = ClassId{2}, .bearing_rad = bearing_rad};
}

/// The sample, with an object that looks different from each side.
MapArchive whole_map() {
  MapArchive archive = test::sample_archive();
  archive.objects.modify(ObjectId{1}, [](Object& object) {
    object.points.observe(std::vector<Eigen::Vector3f>{{0.05F, 0.1F, 0.1F}, {0.085F, 0.1F, 0.1F}});
    object.observation_log.add(detection_at(0.3F));
    object.observation_log.add(detection_at(3.0F));
  });
  archive.objects.erase(archive.objects.add(test::sample_object()));
  return archive;
}

const Object& only_object(const MapArchive& archive) {
  return archive.objects.at(ObjectId{1});
}

void expect_same_rings(const Polygon& a, const Polygon& b) {
  ASSERT_EQ(a.outer.size(), b.outer.size());
  for (std::size_t i = 0; i < a.outer.size(); ++i) {
    EXPECT_LT((a.outer[i] - b.outer[i]).norm(), kRoundingM);
  }
}

void expect_same_places(const Object& a, const Object& b) {
  EXPECT_LT((a.box.min_in_map - b.box.min_in_map).norm(), kRoundingM);
  EXPECT_LT((a.box.max_in_map - b.box.max_in_map).norm(), kRoundingM);
  EXPECT_LT((a.centroid_in_map - b.centroid_in_map).norm(), kRoundingM);
  EXPECT_LT((a.shapes.mean_centroid() - b.shapes.mean_centroid()).norm(), kRoundingM);
  expect_same_rings(*a.shapes.hull(), *b.shapes.hull());
  expect_same_rings(*a.shapes.best(), *b.shapes.best());
  EXPECT_EQ(a.points, b.points);
}

/// Of `from`, the coordinates, which rounding changes, and what is known of the floor, in the rest.
MapArchive with_coordinates_of(const MapArchive& from, MapArchive archive) {
  archive.hypermap = from.hypermap;
  archive.class_grids = from.class_grids;
  archive.floor = from.floor;
  archive.provenance.back().map_from_input = from.provenance.back().map_from_input;
  archive.objects.modify(ObjectId{1}, [&](Object& object) {
    object.box = only_object(from).box;
    object.centroid_in_map = only_object(from).centroid_in_map;
    object.shapes = only_object(from).shapes;
  });
  return archive;
}

TEST(TransformedMap, TheIdentityChangesNothing) {
  EXPECT_EQ(transformed(whole_map(), MapFromOldMap()).value(), whole_map());
}

TEST(TransformedMap, AShiftByWholeVoxelsThereAndBackIsTheSameMapUpToRounding) {
  const MapArchive old = whole_map();
  const MapFromOldMap there = moved_by({1.25, -0.35, 0.6}, 0.0);
  const MapArchive moved = transformed(old, there).value();
  EXPECT_NE(moved.octree, old.octree);
  EXPECT_EQ(moved.objects.next_id(), ObjectId{3});
  const MapArchive back = transformed(moved, MapFromOldMap(there.isometry().inverse())).value();
  expect_same_places(only_object(back), only_object(old));
  EXPECT_EQ(with_coordinates_of(old, back), old);
  const auto& grid = back.hypermap.find_as<OccupancyLayer>("occupancy")->grid;
  const auto& old_grid = old.hypermap.find_as<OccupancyLayer>("occupancy")->grid;
  EXPECT_LT((grid.geometry().origin - old_grid.geometry().origin).norm(), kRoundingM);
  EXPECT_TRUE(std::equal(grid.cells().begin(), grid.cells().end(), old_grid.cells().begin()));
}

TEST(TransformedMap, FourQuarterTurnsAreTheIdentityForOctreeBoxesCentroidsAndVotes) {
  const MapArchive old = whole_map();
  MapArchive turned = old;
  for (int i = 0; i < 4; ++i) {
    turned = transformed(turned, moved_by({0, 0, 0}, kQuarterTurnRad)).value();
  }
  EXPECT_EQ(turned.octree, old.octree);
  expect_same_places(only_object(turned), only_object(old));
}

TEST(TransformedMap, AQuarterTurnByHand) {
  const Object moved =
      only_object(transformed(whole_map(), moved_by({1, 0, 0.5}, kQuarterTurnRad)).value());
  EXPECT_LT((moved.box.min_in_map - Eigen::Vector3d(0.8, 0.0, 0.5)).norm(), kRoundingM);
  EXPECT_LT((moved.box.max_in_map - Eigen::Vector3d(1.0, 0.1, 0.8)).norm(), kRoundingM);
  EXPECT_LT((moved.centroid_in_map - Eigen::Vector3d(0.9, 0.05, 0.65)).norm(), kRoundingM);
}

TEST(TransformedMap, HowOftenAPlaceWasInViewMovesWithIt) {
  const std::vector<Eigen::Vector3f> left{{0.0F, 0.1F, 0.1F}};
  const std::vector<Eigen::Vector3f> right{{0.1F, 0.1F, 0.1F}};
  const auto nothing = [](const Eigen::Vector3d&) { return false; };
  MapArchive archive = whole_map();
  archive.objects.modify(ObjectId{1}, [&](Object& object) {
    object.points = OccupancyVotes();
    for (const auto& seen : {left, left, right}) {
      object.points.observe(seen);
      object.points.look(seen, nothing, 0);
    }
  });
  const MapArchive moved = transformed(archive, moved_by({0.37, 0, 0}, 0.0)).value();
  const OccupancyVotesState& state = only_object(moved).points.state();
  EXPECT_EQ(looks_of_cells(state), (std::vector<std::uint32_t>{2, 1}));
  EXPECT_EQ(state.looks, (std::vector<PointVote>{{{9, 2, 2}, 2}, {{11, 2, 2}, 1}}));
}

TEST(TransformedMap, AnEighthOfATurnGrowsTheBox) {
  const Object moved =
      only_object(transformed(whole_map(), moved_by({0, 0, 0}, 0.5 * kQuarterTurnRad)).value());
  const double side = 0.3 * std::numbers::sqrt2 / 2.0;
  EXPECT_LT((moved.box.extent() - Eigen::Vector3d(side, side, 0.3)).norm(), kRoundingM);
}

TEST(TransformedMap, BearingsTurnByWholeBins) {
  const Object old = only_object(whole_map());
  const Object moved =
      only_object(transformed(whole_map(), moved_by({0, 0, 0}, 2.0 * kBinRad)).value());
  for (std::size_t i = 0; i < 18; ++i) {
    EXPECT_EQ(moved.histogram.bins()[(i + 2) % 18], old.histogram.bins()[i]);
  }
  const ObservationLogState& log = moved.observation_log.state();
  EXPECT_NEAR(log.newest[0].bearing_rad, 0.3 + 2.0 * kBinRad, 1e-6);
  EXPECT_NEAR(log.newest[1].bearing_rad, 3.0 + 2.0 * kBinRad - 4.0 * kQuarterTurnRad, 1e-6);
  for (std::size_t i = 0; i < 2; ++i) {  // both in the order of their bins
    EXPECT_EQ(log.summaries[i].bearing_bin,
              log_bearing_bin(static_cast<double>(log.newest[i].bearing_rad)));
  }
}

TEST(TransformedMap, LayersAnswerAtMovedPointsAsTheyDidBefore) {
  const MapArchive old = whole_map();
  const MapFromOldMap there = moved_by({2.5, -1.0, 0.0}, 0.7);
  const MapArchive moved = transformed(old, there).value();
  const auto& old_grid = old.hypermap.find_as<OccupancyLayer>("occupancy")->grid;
  const auto& grid = moved.hypermap.find_as<OccupancyLayer>("occupancy")->grid;
  const GridGeometry& geometry = old_grid.geometry();
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const Eigen::Vector2d was = centre(geometry, {col, row});
      const Eigen::Vector3d is = there.isometry() * Eigen::Vector3d(was.x(), was.y(), 0.0);
      ASSERT_EQ(grid.at_point(is.head<2>()), old_grid.at({col, row}));
      ASSERT_EQ(moved.class_grids[0].grid.at_point(is.head<2>()),
                old.class_grids[0].grid.at({col, row}));
    }
  }
}

TEST(TransformedMap, LayersInOtherFramesKeepTheirContentAndTheirFramesMove) {
  const MapArchive old = whole_map();
  const MapFromOldMap there = moved_by({2.5, -1.0, 0.3}, 0.4);
  const MapArchive moved = transformed(old, there).value();
  EXPECT_EQ(moved.hypermap.at("semantic").value()->content,
            old.hypermap.at("semantic").value()->content);
  const Eigen::Vector2d was =
      old.hypermap.frames().to_from("map", "lab").value() * Eigen::Vector2d(1.0, 2.0);
  const Eigen::Vector2d is =
      moved.hypermap.frames().to_from("map", "lab").value() * Eigen::Vector2d(1.0, 2.0);
  const Eigen::Vector3d expected = there.isometry() * Eigen::Vector3d(was.x(), was.y(), 0.0);
  EXPECT_LT((is - expected.head<2>()).norm(), kRoundingM);
}

TEST(TransformedMap, TheParentOfMapStaysWhereItWas) {
  MapArchive old;
  ASSERT_TRUE(old.hypermap.frames().add(
      {.frame_id = "earth", .child_frame_id = "map", .x_m = 3.0, .y_m = 1.0, .yaw_rad = 0.2}));
  const MapFromOldMap there = moved_by({2.5, -1.0, 0.0}, 0.4);
  const MapArchive moved = transformed(old, there).value();
  const Eigen::Vector3d point = there.isometry() * Eigen::Vector3d(0.5, 0.25, 0.0);
  const Eigen::Vector2d was =
      old.hypermap.frames().to_from("earth", "map").value() * Eigen::Vector2d(0.5, 0.25);
  const Eigen::Vector2d is =
      moved.hypermap.frames().to_from("earth", "map").value() * point.head<2>();
  EXPECT_LT((is - was).norm(), kRoundingM);
}

TEST(TransformedMap, SemanticObjectsInMapTurnAndLoseTheTextOfTheirOldShape) {
  MapArchive old;
  SemanticObject sink = test::sample_shape(4, "sink", 1.0);
  sink.shape_text = "POLYGON";
  ASSERT_TRUE(old.hypermap.add_layer(
      {.info = {.name = "rooms"}, .content = SemanticLayer::create({sink}).value()}));
  const MapArchive moved = transformed(old, moved_by({0, 0, 0}, kQuarterTurnRad)).value();
  const auto* layer = moved.hypermap.find_as<SemanticLayer>("rooms");
  EXPECT_EQ(layer->at({-0.1, 1.05}), std::vector<std::uint64_t>{4});
  EXPECT_TRUE(layer->at({1.05, 0.1}).empty());
  EXPECT_EQ(layer->find(4)->shape_text, "");
}

TEST(TransformedMap, FramesOfTheSameInputStillFit) {
  MapArchive old = whole_map();
  old.provenance.back().map_from_input =
      MapFromInput(Eigen::Isometry3d(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX())));
  const MapFromOldMap there = moved_by({2.5, -1.0, 0.3}, 0.4);
  const Eigen::Vector3d point(1.0, 2.0, 3.0);
  const Eigen::Vector3d was = old.provenance.back().map_from_input.isometry() * point;
  const Eigen::Vector3d is =
      transformed(old, there).value().provenance.back().map_from_input.isometry() * point;
  EXPECT_LT((is - there.isometry() * was).norm(), kRoundingM);
}

TEST(TransformedMap, NoRunGoesOnFromAMapThatWasMoved) {
  MapArchive old = whole_map();
  old.checkpoint = make_map({{"positions", make_number(3)}});
  const MapArchive moved = transformed(old, moved_by({2.5, -1.0, 0.3}, 0.4)).value();
  EXPECT_EQ(moved.checkpoint, ValueTree{});
}

TEST(TransformedMap, AMovedMapIsWrittenAndReadAgain) {
  const MapArchive moved = transformed(whole_map(), moved_by({2.5, -1.0, 0.3}, 0.4)).value();
  const std::string bytes = write_archive(moved).value();
  EXPECT_EQ(write_archive(parse_archive(bytes, {.file = "moved.hmap"}).value().value).value(),
            bytes);
}

TEST(TransformedMap, ATiltIsRefused) {
  const MapFromOldMap tilted(Eigen::Isometry3d(Eigen::AngleAxisd(2e-6, Eigen::Vector3d::UnitX())));
  const Error refused = transformed(whole_map(), tilted).error();
  EXPECT_EQ(refused.code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(to_string(refused).starts_with("map_from_old: must leave +z up, tilts it by"));
  const MapFromOldMap rounded(Eigen::Isometry3d(Eigen::AngleAxisd(5e-7, Eigen::Vector3d::UnitX())));
  EXPECT_TRUE(transformed(whole_map(), rounded));
}

TEST(TransformedMap, WhatIsNoMotionOrTooFarIsRefused) {
  const auto code_of = [](const Eigen::Isometry3d& transform) {
    const auto refused = transformed(whole_map(), MapFromOldMap(transform));
    return refused ? std::nullopt : std::optional(refused.error().code);
  };
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() *= 2.0;
  EXPECT_EQ(code_of(transform), ErrorCode::kInvalidArgument);
  transform = Eigen::Isometry3d::Identity();
  transform.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(transform), ErrorCode::kInvalidArgument);
  transform.translation().x() = 1e5;
  EXPECT_EQ(code_of(transform), ErrorCode::kLimit);
  transform.translation().x() = 2e6;
  EXPECT_EQ(code_of(transform), ErrorCode::kLimit);
}

TEST(TransformedMap, WhatCannotBeMovedIsRefusedByName) {
  const auto refusal = [](const MapArchive& archive, double rise_m) {
    const auto refused = transformed(archive, moved_by({1, 0, rise_m}, 0.0));
    return refused ? std::string("moved") : to_string(refused.error());
  };
  MapArchive opaque;
  ASSERT_TRUE(opaque.hypermap.add_layer({.info = {.name = "wifi"}, .content = OpaqueLayer("W")}));
  EXPECT_EQ(refusal(opaque, 0.0), "wifi: lies in frame map and cannot be moved");
  EXPECT_EQ(transformed(opaque, MapFromOldMap()).value(), opaque);
  MapArchive beside;
  ASSERT_TRUE(beside.hypermap.add_layer(
      {.info = {.name = "wifi", .frame_id = "lab"}, .content = OpaqueLayer("W")}));
  EXPECT_EQ(refusal(beside, 0.0), "moved");
  EXPECT_NE(refusal(beside, 0.5).find("wifi: may have a height"), std::string::npos);
  MapArchive foreign;
  foreign.foreign_extensions = {make_map({})};
  EXPECT_NE(refusal(foreign, 0.0).find("extensions: one of unknown"), std::string::npos);
  MapArchive other_frame;
  other_frame.extension_entries["hypermap-objects"] = {.format = "hypermap-objects",
                                                       .frame_id = "lab"};
  EXPECT_NE(refusal(other_frame, 0.0).find("hypermap-objects: must lie"), std::string::npos);
  MapArchive octomap;
  octomap.octomaps.push_back(
      {.entry = {.format = "octomap", .name = "theirs"}, .bytes = {}, .tree = {}});
  EXPECT_EQ(refusal(octomap, 0.0), "theirs: lies in frame map and cannot be moved");
}

}  // namespace
}  // namespace hypermap
