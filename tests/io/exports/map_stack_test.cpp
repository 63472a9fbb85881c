// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/map_stack.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/projection/stack/stack_services.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kEdge = 0.05;

/// Voxels along x at y = 0.025, z = 0.525, in an octree without objects: each shows its own class.
/// Of each its log-odds of occupancy and, when it has one, its class.
struct VoxelRow {
  double log_odds;
  int class_id = -1;
};

MapArchive archive_of(const std::vector<std::string>& classes,
                      const std::vector<VoxelRow>& voxels) {
  MapArchive archive;
  for (const std::string& name : classes) (void)archive.classes.add(name).value();
  archive.octree = SemanticOctree::create({}).value();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const double x = kEdge * (static_cast<double>(i) + 0.5);
    const auto key = archive.octree->grid().key(PointInMap{{x, kEdge / 2, 0.525}});
    VoxelLabel label;
    if (voxels[i].class_id >= 0) {
      label.classes[0] = {static_cast<std::uint16_t>(voxels[i].class_id), 2000};
    }
    const auto steps = static_cast<std::int16_t>(voxels[i].log_odds * 1000);
    EXPECT_TRUE(archive.octree->set_leaf({.key = key.value(), .log_odds = steps, .label = label}));
  }
  return archive;
}

constexpr HeightBand kThin{.min_m = 0.5, .max_m = 0.55};

std::vector<std::string> layer_names(const GridStack& stack) {
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack.layers()) names.push_back(name);
  return names;
}

TEST(MapStack, HasALayerForEachClass) {
  const MapArchive archive =
      archive_of({"chair", "cup", "sofa"}, {{2.0, 0}, {3.0, 1}, {-1.5}, {1.2}});
  const GridStack stack = stack_of_map(archive, {.of_classes = {.band = kThin}}).value();
  EXPECT_THAT(layer_names(stack), ElementsAre("/ism/chair", "/ism/cup"));
  EXPECT_EQ(stack.options().frame_id, "map");
  const auto chair = stack.layers().at("/ism/chair").cells();
  ASSERT_EQ(chair.size(), 4U);
  EXPECT_EQ(chair[0], 2693);   // of three classes: 2 + ln 2
  EXPECT_EQ(chair[1], -2693);  // a cup
  EXPECT_EQ(chair[2], -1500);  // free
  EXPECT_EQ(chair[3], -1200);  // something without a class
  EXPECT_THAT(
      layer_names(
          stack_of_map(archive, {.of_classes = {.band = kThin, .classes = {"Cup"}}}).value()),
      ElementsAre("/ism/cup"));
}

TEST(MapStack, FusesOccupancyLayersByTheirFramesAndWeights) {
  MapArchive archive = archive_of({"chair"}, {{2.0, 0}, {2.0, 0}, {2.0, 0}});
  ASSERT_TRUE(
      archive.hypermap.frames().add({.frame_id = "map", .child_frame_id = "robot", .x_m = kEdge}));
  const GridGeometry two{.resolution_m = kEdge, .cols = 2, .rows = 1};
  const auto grid = OccupancyGrid::create(two, std::vector<std::int8_t>{80, 20}).value();
  for (const auto& [name, frame] : {std::pair{"laser", "robot"}, {"lost", "moon"}}) {
    ASSERT_TRUE(archive.hypermap.add_layer(
        {LayerInfo{.name = name, .frame_id = frame}, OccupancyLayer(grid)}));
  }
  const MapStackRequest request{.of_classes = {.band = kThin},
                                .fused = {{.name = "laser", .weight = 0.5}}};
  const GridStack stack = stack_of_map(archive, request).value();
  EXPECT_THAT(layer_names(stack), ElementsAre("/ism/chair", "/ism/laser"));
  // ln 4 = 1.386, halved, one cell further.
  EXPECT_THAT(stack.layers().at("/ism/laser").cells(), ElementsAre(0, 693, -693));
  const auto what = [&](const char* name) {
    const auto failed =
        stack_of_map(archive, {.of_classes = {.band = kThin}, .fused = {{.name = name}}});
    return failed ? std::string() : to_string(failed.error());
  };
  EXPECT_THAT(what("lost"), HasSubstr("moon"));
  EXPECT_THAT(what("lasre"), HasSubstr("laser"));
}

TEST(MapStack, ANameWithSlashesIsOneLayer) {
  const GridStack stack =
      stack_of_map(archive_of({"a/b", "a_b", "//"}, {{2.0, 0}, {2.0, 1}, {2.0, 2}}),
                   {.of_classes = {.band = kThin}})
          .value();
  EXPECT_THAT(layer_names(stack), ElementsAre("/ism/__", "/ism/a_b", "/ism/a_b-1"));
}

TEST(MapStack, WhatIsNotThereIsSaid) {
  const MapArchive archive = archive_of({"chair"}, {{2.0, 0}});
  const auto what = [&](const MapStackRequest& request) {
    const auto failed = stack_of_map(archive, request);
    return failed ? std::string() : to_string(failed.error());
  };
  EXPECT_THAT(what({.of_classes = {.band = {.min_m = 3, .max_m = 4}}}),
              HasSubstr("between heights of 3 and 4 m"));
  EXPECT_THAT(what({.of_classes = {.band = kThin, .classes = {"chiar"}}}), HasSubstr("chair"));
  EXPECT_THAT(what({.of_classes = {.band = {.min_m = 4, .max_m = 3}}}), HasSubstr("height_band"));
  EXPECT_FALSE(stack_of_map(MapArchive{}, {}));
  EXPECT_THAT(what({.of_classes = {.band = {.min_m = 0.3, .max_m = 0.4}}}),
              HasSubstr("--min-height, --max-height: no voxel lies between heights of 0.3"));
}

TEST(MapStack, WhyThereIsNoLayerIsSaid) {
  const auto why = [](const MapArchive& archive, const std::vector<std::string>& classes) {
    const auto failed = stack_of_map(archive, {.of_classes = {.band = kThin, .classes = classes}});
    EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
    return to_string(failed.error());
  };
  const MapArchive without = archive_of({"chair"}, {{2.0}});
  EXPECT_THAT(why(without, {}),
              AllOf(HasSubstr("the map's voxels have no class"), HasSubstr("--fuse occupancy")));
  const std::string in_band = "lies between heights of 0.5 and 0.55 m";
  EXPECT_THAT(why(archive_of({"chair", "cup"}, {{2.0, 0}}), {"cup"}),
              HasSubstr("--class: no voxel of cup " + in_band));
  MapArchive above = without;
  const auto key = above.octree->grid().key(PointInMap{{kEdge / 2, kEdge / 2, 1.025}});
  VoxelLabel chair;
  chair.classes[0] = {0, 2000};
  EXPECT_TRUE(above.octree->set_leaf({.key = key.value(), .log_odds = 2000, .label = chair}));
  EXPECT_THAT(why(above, {}),
              HasSubstr("--min-height, --max-height: no voxel that has a class " + in_band));
}

TEST(MapStack, CellsWithoutAClassAreCounted) {
  // A chair, a wall twice, free space.
  const MapArchive archive = archive_of({"chair"}, {{2.0, 0}, {2.0}, {1.0}, {-1.5}});
  EXPECT_EQ(num_cells_without_class(archive, kThin).value(), 2U);
  EXPECT_EQ(num_cells_without_class(archive, {.min_m = 3, .max_m = 4}).value(), 0U);
  EXPECT_EQ(num_cells_without_class(MapArchive{}, kThin).error().code, ErrorCode::kNotFound);
}

TEST(MapStack, ItsBandIsOverTheFloor) {
  MapArchive archive = archive_of({"chair"}, {{2.0, 0}, {2.0}, {1.0}, {-1.5}});
  const GridStack stack = stack_of_map(archive, {.of_classes = {.band = kThin}}).value();
  archive.floor.height_m = -10.0;
  constexpr HeightBand kRaised{.min_m = 10.5, .max_m = 10.55};
  const GridStack same = stack_of_map(archive, {.of_classes = {.band = kRaised}}).value();
  EXPECT_EQ(same.layers(), stack.layers());
  EXPECT_EQ(num_cells_without_class(archive, kRaised).value(), 2U);
  EXPECT_FALSE(stack_of_map(archive, {.of_classes = {.band = kThin}}));
}

TEST(MapStack, ItsMapsAreKnownInAFolder) {
  const MapArchive archive = archive_of({"chair"}, {{2.0, 0}});
  const GridStack stack = stack_of_map(archive, {.of_classes = {.band = kThin}}).value();
  const test::TempDir dir;
  EXPECT_FALSE(holds_stack_maps(dir / "grids").value());
  const LogOddsGrid combined = pooled(stack, Pooling::kMaximum).value();
  ASSERT_TRUE(write_stack_maps(stack, combined, dir / "grids"));
  EXPECT_TRUE(holds_stack_maps(dir / "grids").value());
  std::filesystem::remove(dir / "grids" / "combined.yaml");
  EXPECT_FALSE(holds_stack_maps(dir / "grids").value());
}

TEST(MapStack, IsWrittenAsMapsOfMapServer) {
  const MapArchive archive = archive_of({"chair", "combined"}, {{2.0, 0}, {3.0, 1}, {-1.5}, {1.2}});
  const GridStack stack = stack_of_map(archive, {.of_classes = {.band = kThin}}).value();
  // P = 0.66, 0.64, 0.2, 0.19: thresholds 0.65 and 0.196.
  const LogOddsGrid combined =
      LogOddsGrid::of_probabilities(stack.geometry(), std::vector{0.66, 0.64, 0.2, 0.19}).value();
  const test::TempDir dir;
  const auto written = write_stack_maps(stack, combined, dir / "grids").value();
  ASSERT_EQ(written.size(), 9U);
  const auto cells = [&](const char* name) {
    const auto map = read_map(dir / "grids" / name).value();
    return std::vector<int>(map.value.grid.cells().begin(), map.value.grid.cells().end());
  };
  EXPECT_THAT(cells("combined.yaml"), ElementsAre(100, -1, -1, 0));
  EXPECT_THAT(trinary_cells(combined).value().cells(), ElementsAre(100, -1, -1, 0));
  // Log-odds 2, -3, -1.5 and -1.2: P = 0.88, 0.05, 0.18, 0.23.
  EXPECT_THAT(cells("chair.yaml"), ElementsAre(100, 0, 0, -1));
  EXPECT_THAT(cells("combined-2.yaml"), ElementsAre(0, 100, 0, -1));  // a class of that name
}

TEST(MapStack, AFolderNeverHoldsMapsOfTwoStacks) {
  const MapArchive archive = archive_of({"chair", "cup"}, {{2.0, 0}, {3.0, 1}});
  const test::TempDir dir;
  const auto write = [&](const std::vector<std::string>& classes) {
    const GridStack stack =
        stack_of_map(archive, {.of_classes = {.band = kThin, .classes = classes}}).value();
    return write_stack_maps(stack, pooled(stack, Pooling::kMaximum).value(), dir / "grids");
  };
  const auto there = [&] {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(dir / "grids"))
      files.insert(entry.path());
    return files;
  };
  ASSERT_TRUE(write({}));
  ASSERT_EQ(there().size(), 9U);
  const auto of_cup = write({"cup"});
  ASSERT_TRUE(of_cup) << to_string(of_cup.error());
  EXPECT_EQ(there(), std::set<std::filesystem::path>(of_cup->begin(), of_cup->end()));

  test::write_text(dir / "grids" / "notes.txt", "mine");
  const auto before = there();
  const auto refused = write({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("'notes.txt' in it is no part of"));
  EXPECT_EQ(there(), before);
}

TEST(MapStack, MapsWithoutACombinedOneAreNoStack) {
  const MapArchive archive = archive_of({"chair"}, {{2.0, 0}});
  const GridStack stack = stack_of_map(archive, {.of_classes = {.band = kThin}}).value();
  const LogOddsGrid combined = pooled(stack, Pooling::kMaximum).value();
  const test::TempDir dir;
  ASSERT_TRUE(write_stack_maps(stack, combined, dir / "grids"));
  std::filesystem::remove(dir / "grids" / "combined.yaml");
  const auto refused = write_stack_maps(stack, combined, dir / "grids");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(std::filesystem::exists(dir / "grids" / "chair.yaml"));
}

}  // namespace
}  // namespace hypermap
