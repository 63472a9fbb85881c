// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
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

TEST(OccupancyProjection, WhatWasNotSeenFreeNearTheFloorIsNotFree) {
  Voxels voxels;  // the lowest free leaf 0.2, 0.3 m over the band's lower end
  voxels.column(0, 0, 3, 11).column(1, 0, 4, 11);
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand)), ElementsAre(0, -1));
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand, {.max_unseen_m = 0.3})),
              ElementsAre(0, 0));
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand, {.max_unseen_m = 0})),
              ElementsAre(-1, -1));
}

/// Cells along x. At 0.7 m something was measured in the first one, in `edge_leaves` leaves; of the
/// others all was seen free but `num_hidden` leaves from 0.7 m on.
std::vector<std::int8_t> cells_beside_an_edge(int num_hidden, int edge_leaves, int num_cells = 5) {
  Voxels voxels;
  voxels.column(0, 0, 1, 7).column(0, 0, 7, 7 + edge_leaves, true);
  voxels.column(0, 0, 7 + edge_leaves, 11);
  for (int x = 1; x < num_cells; ++x) voxels.column(x, 0, 1, 7).column(x, 0, 7 + num_hidden, 11);
  return grid_cells(*project_occupancy(voxels.source(), kBand));
}

TEST(OccupancyProjection, ATopGoesOnBesideItsEdgeWhereItsHeightWasNotSeen) {
  EXPECT_THAT(cells_beside_an_edge(1, 1), ElementsAre(100, -1, 0, 0, 0)) << "0.1 m of 0.15";
  EXPECT_THAT(cells_beside_an_edge(2, 1), ElementsAre(100, -1, 0, 0, 0));
  EXPECT_THAT(cells_beside_an_edge(0, 1), ElementsAre(100, 0, 0, 0, 0)) << "looked through";
  EXPECT_THAT(cells_beside_an_edge(3, 1), ElementsAre(100, 0, 0, 0, 0)) << "no picture reached it";
  EXPECT_THAT(cells_beside_an_edge(1, 2), ElementsAre(100, 0, 0, 0, 0)) << "of 0.2 m: no top";
}

TEST(OccupancyProjection, ATopGoesOnAtItsOwnHeight) {
  // The edge is at leaf 5; of its neighbour one leaf was not seen.
  for (const auto& [unseen, is_free] :
       {std::pair(3, true), {4, false}, {5, false}, {6, false}, {7, true}}) {
    Voxels voxels;
    voxels.column(0, 0, 1, 11).add(0, 0, 5, true);
    voxels.column(1, 0, 1, unseen).column(1, 0, unseen + 1, 11);
    const auto grid = project_occupancy(voxels.source(), kBand);
    EXPECT_EQ(grid->at({1, 0}), is_free ? kFreeCell : kUnknownCell) << unseen;
  }
}

TEST(OccupancyProjection, WhatWasNotSeenAtTheEndsOfTheBandIsHiddenByNothing) {
  for (const int unseen : {1, 10}) {
    Voxels voxels;
    voxels.column(0, 0, 1, 11).add(0, 0, unseen, true).column(1, 0, 2, 10);
    voxels.add(1, 0, unseen == 1 ? 10 : 1, false);
    EXPECT_EQ(project_occupancy(voxels.source(), kBand)->at({1, 0}), kFreeCell) << unseen;
  }
}

TEST(OccupancyProjection, ATopEndsAtWhatIsOccupiedAndGoesOnToAllSides) {
  // A row of five cells with a post at the third one, and a cell beside the edge in the next row.
  Voxels voxels;
  const auto all_but_the_top = [&](int x, int y) { voxels.column(x, y, 1, 7).column(x, y, 8, 11); };
  voxels.add(1, 0, 7, true).column(2, 0, 1, 11, true);
  all_but_the_top(0, 0);
  all_but_the_top(3, 0);
  all_but_the_top(1, 1);
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand)),
              ElementsAre(-1, 100, 100, 0, -1, -1, -1, -1));
}

TEST(OccupancyProjection, LevelsAreThoseOfTheLeavesWhateverTheBand) {
  Voxels voxels;
  voxels.column(0, 0, 0, 12).add(0, 0, 7, true).column(1, 0, 0, 7).column(1, 0, 8, 12);
  for (const double off_m : {0.0, 0.03, 0.05, 0.07}) {
    const HeightBand band{.min_m = 0.1 + off_m, .max_m = 1.0 + off_m};
    EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), band)), ElementsAre(100, -1))
        << off_m;
  }
}

TEST(OccupancyProjection, NoLevelIsHiddenInCellsWiderThanATopGoesOn) {
  Voxels voxels;
  voxels.column(0, 0, 1, 7).add(0, 0, 7, true);
  for (int x = 1; x < 4; ++x) voxels.column(x, 0, 1, 7).column(x, 0, 8, 11);
  const OccupancyProjectionOptions wide{.resolution_m = 0.2, .min_free_share = 0.4};
  EXPECT_THAT(grid_cells(*project_occupancy(voxels.source(), kBand, wide)), ElementsAre(100, 0));
}

TEST(OccupancyProjection, ATopGoesOnForThreeLeavesOf5Cm) {
  std::vector<LeafSample> leaves;
  const auto add = [&](int x, int z, bool occupied) {
    leaves.push_back({.centre_in_map = 0.05 * Eigen::Vector3d(x + 0.5, 0.5, z + 0.5),
                      .edge_m = 0.05,
                      .occupancy = {},
                      .occupied = occupied});
  };
  for (int x = 0; x < 6; ++x) {
    for (int z = 2; z < 36; ++z) {
      if (z != 14) add(x, z, false);
    }
  }
  add(0, 14, true);
  const LeafSource source = [&](const LeafVisitor& visit) {
    for (const LeafSample& leaf : leaves) visit(leaf);
  };
  EXPECT_THAT(grid_cells(*project_occupancy(source)), ElementsAre(100, -1, -1, -1, 0, 0));
  // The same over a band of so many leaves that levels are of two of them.
  const HeightBand high{.min_m = 0.1, .max_m = 3.3};
  EXPECT_THAT(grid_cells(*project_occupancy(source, high, {.min_free_share = 0.4})),
              ElementsAre(100, 0, 0, 0, 0, 0));
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
