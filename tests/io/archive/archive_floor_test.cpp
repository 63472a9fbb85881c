// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_floor.hpp"

#include "archive_edits.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/archive/transformed_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using testing::HasSubstr;

constexpr MapFloor kFoundBelow{.height_m = -1.35, .source = FloorSource::kFound};
constexpr MapFloor kStatedAbove{.height_m = 0.4, .source = FloorSource::kStated};

/// A room of 3 x 3 x 2 m whose floor is the level of voxels of 10 cm `z`, with a wall and a chair
/// that stands on it.
MapArchive room(int z) {
  MapArchive archive{.hypermap = {}};
  archive.octree = SemanticOctree::create({.resolution_m = 0.1}).value();
  for (int x = 0; x < 30; ++x) {
    for (int y = 0; y < 30; ++y) {
      for (int above = 0; above < 20; ++above) {
        const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + x),
                           static_cast<std::uint16_t>(kOriginKey + y),
                           static_cast<std::uint16_t>(kOriginKey + z + above)};
        const bool is_occupied = above == 0 || x == 0;
        EXPECT_TRUE(archive.octree->set_leaf(
            {.key = key, .log_odds = static_cast<MilliLogOdds>(is_occupied ? 847 : -405)}));
      }
    }
  }
  const ClassId chair = archive.classes.add("chair").value();
  Object object;
  object.belief.observe(std::array{ClassEvidence{chair, Probability(0.9)}}, Probability(0.5));
  const double floor_m = 0.1 * z;
  object.box = {{1.0, 1.0, floor_m + 0.1}, {1.5, 1.5, floor_m + 0.9}};
  object.centroid_in_map = object.box.centre();
  archive.objects.add(object);
  return archive;
}

const OccupancyGrid& occupancy_of(const MapArchive& archive) {
  return archive.hypermap.find_as<OccupancyLayer>(kOccupancyLayer)->grid;
}

MapFloor floor_of(const MapArchive& archive) {
  return shown_floor(archive, leaf_source(*archive.octree));
}

MapArchive raised(const MapArchive& archive, double by_m) {
  return transformed(archive,
                     MapFromOldMap(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, by_m))))
      .value();
}

/// Without its lowest level.
MapArchive without_floor_voxels(MapArchive archive) {
  const SemanticOctree whole = *archive.octree;
  const double low_m = archive.objects.objects().begin()->box.min_in_map.z() - 1e-6;
  archive.octree = SemanticOctree::create(whole.options()).value();
  whole.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (whole.grid().centre(leaf.key).xyz.z() < low_m) return;
    EXPECT_TRUE(archive.octree->set_leaf(leaf));
  });
  return archive;
}

TEST(ArchiveFloor, WhatIsStatedComesFirstThenWhatIsShownThenWhatWasThere) {
  MapArchive archive = room(-14);
  EXPECT_EQ(floor_of(archive), kFoundBelow);
  EXPECT_EQ(known_floor_m(archive), -1.35);
  archive.floor = kStatedAbove;
  EXPECT_EQ(floor_of(archive), kStatedAbove);
  EXPECT_EQ(known_floor_m(archive), 0.4);
  archive = without_floor_voxels(std::move(archive));
  archive.floor = kFoundBelow;
  EXPECT_EQ(floor_of(archive), kFoundBelow) << "it was seen once";
  EXPECT_EQ(known_floor_m(archive), std::nullopt);
}

TEST(ArchiveFloor, WithinAVoxelAndAHalfOfWhereItIsAssumedItStaysThere) {
  EXPECT_EQ(floor_of(room(0)), MapFloor{});
  EXPECT_EQ(floor_of(room(1)), MapFloor{}) << "0.15 m";
  EXPECT_EQ(floor_of(room(-2)), MapFloor{}) << "-0.15 m";
  EXPECT_EQ(floor_of(room(2)).source, FloorSource::kFound);
  EXPECT_EQ(known_floor_m(room(1)), 0.15);
  EXPECT_EQ(floor_of(raised(room(1), 3.0)), (MapFloor{.height_m = 3.0}));
}

TEST(ArchiveFloor, IsThatOfTheLargestRegion) {
  MapArchive archive = room(0);
  for (int i = 0; i < 400; ++i) {  // 2 m2 of something else, 100 m away and 2 m lower
    for (int above = 0; above < 2; ++above) {
      const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + 1000 + i % 20),
                         static_cast<std::uint16_t>(kOriginKey + i / 20),
                         static_cast<std::uint16_t>(kOriginKey - 20 + above)};
      ASSERT_TRUE(archive.octree->set_leaf(
          {.key = key, .log_odds = static_cast<MilliLogOdds>(above == 0 ? 847 : -405)}));
    }
  }
  EXPECT_EQ(known_floor_m(archive), 0.05);
  ASSERT_TRUE(derive_layers(archive, {}, {}));
  EXPECT_EQ(archive.floor, MapFloor{});
}

TEST(ArchiveFloor, LayersAreOverIt) {
  MapArchive at_zero = room(0);
  MapArchive below = room(-14);
  ASSERT_TRUE(derive_layers(at_zero, {}, {.floor_m = 0.05}));
  ASSERT_TRUE(derive_layers(below, {}, {}));
  EXPECT_EQ(below.floor, kFoundBelow);
  EXPECT_EQ(occupancy_of(below), occupancy_of(at_zero));
  EXPECT_EQ(std::ranges::count(occupancy_of(below).cells(), kFreeCell), 29 * 30);
}

TEST(ArchiveFloor, AnOptionStatesIt) {
  MapArchive archive = room(-14);
  ASSERT_TRUE(derive_layers(archive, {}, {.floor_m = 0.0}));
  EXPECT_EQ(archive.floor, (MapFloor{.height_m = 0.0, .source = FloorSource::kStated}));
  EXPECT_EQ(std::ranges::count(occupancy_of(archive).cells(), kFreeCell), 0)
      << "less than half of the band was seen";
}

TEST(ArchiveFloor, AMapThatIsRaisedHasTheSameLayersAndRelations) {
  MapArchive archive = room(0);
  ASSERT_TRUE(derive_layers(archive, {}, {}));
  MapArchive moved = raised(archive, 12.0);
  EXPECT_EQ(moved.floor, (MapFloor{.height_m = 12.0}));
  ASSERT_TRUE(derive_layers(moved, {}, {}));
  EXPECT_EQ(moved.floor, (MapFloor{.height_m = 12.0}));
  EXPECT_EQ(occupancy_of(moved), occupancy_of(archive));
  for (MapArchive* map : {&archive, &moved}) {
    map->hypermap.remove_layer(kSemanticLayer);  // all objects count as confirmed
    const RelationGraph graph = archive_relations(*map);
    ASSERT_EQ(graph.supports.size(), 1U);
    EXPECT_EQ(graph.supports.front().kind, SupportKind::kFloor);
  }
  moved.floor = {};
  EXPECT_EQ(archive_relations(moved).supports.front().kind, SupportKind::kUnknown);
}

TEST(ArchiveFloor, MovesWithTheMapThereAndBack) {
  MapArchive archive = room(-14);
  for (const MapFloor& floor : {MapFloor{}, kFoundBelow, kStatedAbove}) {
    archive.floor = floor;
    const MapArchive there = raised(archive, 0.3);
    EXPECT_NEAR(there.floor.height_m, floor.height_m + 0.3, 1e-9);
    EXPECT_EQ(there.floor.source, floor.source);
    EXPECT_EQ(raised(there, -0.3).floor, floor);
  }
  const MapFromOldMap too_far(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 2e5)));
  EXPECT_EQ(transformed(archive, too_far).error().field, "floor");
}

MapArchive with_floor(MapArchive archive, const MapFloor& floor) {
  archive.floor = floor;
  return archive;
}

TEST(MergedFloor, IsWhatIsStatedWhereNothingShowsAnother) {
  const MapFloor near{.height_m = 0.1, .source = FloorSource::kStated};
  const MapFloor other{.height_m = 0.5, .source = FloorSource::kStated};
  const MapArchive shows = room(0);
  const MapArchive hidden = without_floor_voxels(room(0));
  EXPECT_EQ(merged_floor(with_floor(shows, kStatedAbove), with_floor(shows, other)), kStatedAbove);
  EXPECT_EQ(merged_floor(shows, with_floor(shows, near)), near);
  EXPECT_EQ(merged_floor(shows, with_floor(shows, other)), MapFloor{}) << "the map shows another";
  EXPECT_EQ(merged_floor(hidden, with_floor(shows, other)), other);
}

TEST(MergedFloor, WhatOneMapShowsIsMoreThanWhatTheOtherAssumes) {
  const MapArchive shows = room(0);
  const MapArchive hidden = raised(without_floor_voxels(room(0)), 3.0);
  EXPECT_EQ(merged_floor(shows, hidden), MapFloor{});
  EXPECT_EQ(merged_floor(hidden, shows), MapFloor{});
  EXPECT_EQ(merged_floor(hidden, hidden), (MapFloor{.height_m = 3.0}));
}

TEST(StoredFloor, IsReadAsItWasWritten) {
  for (const MapFloor& floor : {kFoundBelow, kStatedAbove, MapFloor{}, MapFloor{.height_m = 2.5}}) {
    MapArchive archive = room(0);
    archive.floor = floor;
    const auto bytes = write_archive(archive);
    ASSERT_TRUE(bytes) << to_string(bytes.error());
    const auto read = parse_archive(*bytes, {});
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->value, archive);
    EXPECT_TRUE(read->findings.empty());
  }
}

TEST(StoredFloor, IsKeptWithTheObjectsWhereThereIsNoOctree) {
  MapArchive archive = room(0);
  archive.octree.reset();
  archive = raised(archive, 12.0);
  const auto read = parse_archive(write_archive(archive).value(), {});
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->value.floor, (MapFloor{.height_m = 12.0}));
  EXPECT_EQ(read->value, archive);
}

TEST(StoredFloor, IsReadWithoutTheOctree) {
  MapArchive archive = room(0);
  archive.floor = kStatedAbove;
  const auto path = std::filesystem::path(testing::TempDir()) / "stored_floor.hmap";
  ASSERT_TRUE(save_archive(archive, path));
  const auto part = load_archive_parts(path, {.octrees = false});
  ASSERT_TRUE(part) << to_string(part.error());
  EXPECT_EQ(part->value.map.floor, kStatedAbove);
  std::filesystem::remove(path);
}

TEST(StoredFloor, OfAWrongFormIsToldAndCostsNoOctree) {
  MapArchive archive = room(0);
  archive.floor = kStatedAbove;
  const std::string bytes = write_archive(archive).value();
  const std::string config = test::member_of(bytes, "hmap_config.yaml");
  for (const auto& [from, to] : {std::pair("floor_source: stated", "floor_source: guessed"),
                                 std::pair("floor_m: 0.4", "floor_m: .nan"),
                                 std::pair("floor_m: 0.4", "floor_m: 2e6")}) {
    const std::string edited = test::replaced(config, from, to);
    const auto read = parse_archive(test::changed(bytes, {{"hmap_config.yaml", edited}}), {});
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->value.floor, MapFloor{});
    EXPECT_EQ(read->value.octree, archive.octree);
    ASSERT_EQ(read->findings.size(), 1U);
    const Error& error = read->findings.front().error;
    EXPECT_THAT(error.field, HasSubstr("floor_"));
    EXPECT_GT(error.line, 0);
    EXPECT_THAT(to_string(error), HasSubstr("hmap_config.yaml"));
  }
}

}  // namespace
}  // namespace hypermap
