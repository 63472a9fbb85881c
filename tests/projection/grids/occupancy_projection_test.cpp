// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;

struct Voxels {
  std::vector<LeafSample> leaves;

  /// The leaf of edge 0.1 m whose lowest corner is at these multiples of 0.1 m.
  Voxels& add(int x, int y, int z, bool occupied) {
    leaves.push_back({.centre_in_map = 0.1 * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5),
                      .edge_m = 0.1,
                      .occupancy = {},
                      .occupied = occupied});
    return *this;
  }
  Voxels& column(int x, int y, int from, int to, bool occupied = false) {
    for (int z = from; z < to; ++z) add(x, y, z, occupied);
    return *this;
  }
  [[nodiscard]] LeafSource source() const {
    return [this](const LeafVisitor& visit) {
      for (const LeafSample& leaf : leaves) visit(leaf);
    };
  }
};

const HeightBand kBand{.min_m = 0.1, .max_m = 1.1};  // ten leaves high

std::vector<std::int8_t> grid_cells(const OccupancyGrid& grid) {
  return {grid.cells().begin(), grid.cells().end()};
}

TEST(OccupancyProjection, OneOccupiedLeafBlocksItsColumn) {
  Voxels voxels;
  voxels.column(0, 0, 1, 11).add(0, 0, 5, true).column(1, 0, 1, 11);
  const auto grid = project_occupancy(voxels.source(), kBand);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->geometry().cols, 2);
  EXPECT_EQ(grid->geometry().rows, 1);
  EXPECT_DOUBLE_EQ(grid->geometry().resolution_m, 0.1);
  EXPECT_THAT(grid_cells(*grid), ElementsAre(100, 0));
}

TEST(OccupancyProjection, UnknownIsNotFree) {
  Voxels voxels;
  voxels.column(0, 0, 1, 6).column(1, 0, 1, 5).column(3, 0, 1, 11);  // 5, 4, 0 and 10 of ten
  const auto grid = project_occupancy(voxels.source(), kBand);
  EXPECT_THAT(grid_cells(*grid), ElementsAre(0, -1, -1, 0));
  const auto strict = project_occupancy(voxels.source(), kBand, {.min_free_share = 1.0});
  EXPECT_THAT(grid_cells(*strict), ElementsAre(-1, -1, -1, 0));
}

TEST(OccupancyProjection, FloorAndCeilingAreNotInTheBand) {
  Voxels voxels;
  voxels.add(0, 0, 0, true).add(0, 0, 11, true).column(0, 0, 1, 11);
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand)), ElementsAre(0));
}

TEST(OccupancyProjection, ALeafThatReachesIntoTheBandCounts) {
  Voxels voxels;
  voxels.add(0, 0, 1, true);
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), {.min_m = 0.15, .max_m = 1.0})),
              ElementsAre(100));
  EXPECT_EQ(project_occupancy(voxels.source(), {.min_m = 0.2, .max_m = 1.0})->cells().size(), 0U);
}

TEST(OccupancyProjection, CellsLieOnMultiplesOfTheResolution) {
  Voxels voxels;
  voxels.add(-3, 7, 4, true).add(2, 9, 4, true);
  const auto grid = project_occupancy(voxels.source(), kBand);
  EXPECT_NEAR(grid->geometry().origin.x(), -0.3, 1e-12);
  EXPECT_NEAR(grid->geometry().origin.y(), 0.7, 1e-12);
  EXPECT_EQ(grid->geometry().cols, 6);
  EXPECT_EQ(grid->geometry().rows, 3);
  EXPECT_EQ(grid->at({0, 0}), 100);
  EXPECT_EQ(grid->at({5, 2}), 100);
  EXPECT_EQ(grid->counts().unknown, 16U);
}

TEST(OccupancyProjection, ALargeFreeLeafFillsAllColumnsBelowIt) {
  Voxels voxels;  // an octree's pruned leaf of 0.4 m and a small one that sets the resolution
  voxels.leaves.push_back(
      {.centre_in_map = {0.2, 0.2, 0.3}, .edge_m = 0.4, .occupancy = {}, .occupied = false});
  voxels.add(4, 0, 2, true);
  const auto grid = project_occupancy(voxels.source(), {.min_m = 0.1, .max_m = 0.6});
  EXPECT_EQ(grid->geometry().cols, 5);
  EXPECT_EQ(grid->counts().free, 16U);
  EXPECT_EQ(grid->counts().occupied, 1U);
}

TEST(OccupancyProjection, ACoarserGridTakesTheMeanOfWhatWasSeenFree) {
  // A cell of 0.2 m over four columns; three seen free over the whole band: 75 %.
  Voxels voxels;
  voxels.column(0, 0, 1, 11).column(1, 0, 1, 11).column(0, 1, 1, 11);
  const auto source = voxels.source();
  EXPECT_THAT(
      grid_cells(*project_occupancy(source, kBand, {.resolution_m = 0.2, .min_free_share = 0.7})),
      ElementsAre(0));
  EXPECT_THAT(
      grid_cells(*project_occupancy(source, kBand, {.resolution_m = 0.2, .min_free_share = 0.8})),
      ElementsAre(-1));
}

TEST(OccupancyProjection, AGivenGridIsFilledAlsoWhenItIsTurned) {
  Voxels voxels;
  voxels.add(10, 10, 3, true);  // centre (1.05, 1.05)
  const GridGeometry turned{.resolution_m = 0.1,
                            .origin = {1.05, 1.05},
                            .yaw_rad = 0.78539816339744831,
                            .cols = 3,
                            .rows = 3};
  const auto grid = project_occupancy(voxels.source(), kBand, {.geometry = turned});
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->geometry(), turned);
  EXPECT_EQ(grid->at({0, 0}), 100);
  EXPECT_EQ(grid->at({2, 2}), -1);
}

TEST(OccupancyProjection, ATurnOfNothingGivesTheSameAsTheStraightWay) {
  Voxels voxels;
  for (int i = 0; i < 40; ++i) voxels.column(i % 7, i % 5, 1, 1 + i % 11, i % 13 == 0);
  GridGeometry straight = *projection_geometry(voxels.source(), kBand);
  const auto a = project_occupancy(voxels.source(), kBand, {.geometry = straight});
  straight.yaw_rad = 1e-15;
  const auto b = project_occupancy(voxels.source(), kBand, {.geometry = straight});
  EXPECT_EQ(grid_cells(*a), grid_cells(*b));
}

TEST(OccupancyProjection, AnEmptyMapGivesAGridWithoutCells) {
  EXPECT_EQ(project_occupancy(Voxels().source())->cells().size(), 0U);
}

TEST(OccupancyProjection, WrongOptionsAreNamed) {
  const auto source = Voxels().source();
  EXPECT_EQ(project_occupancy(source, {.min_m = 1, .max_m = 1}).error().field, "height_band");
  EXPECT_EQ(project_occupancy(source, {.min_m = std::nan("")}).error().field, "height_band");
  EXPECT_EQ(project_occupancy(source, {}, {.min_free_share = 0}).error().field, "min_free_share");
  EXPECT_EQ(project_occupancy(source, {}, {.resolution_m = -1}).error().field, "resolution_m");
  Voxels far;
  far.add(0, 0, 3, true).add(9'000'000, 0, 3, true);
  EXPECT_EQ(project_occupancy(far.source()).error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace hypermap
