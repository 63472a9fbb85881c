// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/class_grids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;

LeafSample leaf(int x, int z, bool occupied, std::optional<ClassId> id = std::nullopt) {
  return {.centre_in_map = 0.1 * Eigen::Vector3d(x + 0.5, 0.5, z + 0.5),
          .edge_m = 0.1,
          .occupancy = {},
          .occupied = occupied,
          .best_class = id};
}

LeafSource source_of(const std::vector<LeafSample>& leaves) {
  return [&leaves](const LeafVisitor& visit) {
    for (const LeafSample& sample : leaves) visit(sample);
  };
}

std::vector<std::int8_t> cells(const OccupancyGrid& grid) {
  return {grid.cells().begin(), grid.cells().end()};
}

TEST(ClassGrids, EachClassHasItsGridAndUnknownStaysUnknown) {
  const ClassId chair{3};
  const ClassId table{1};
  const std::vector<LeafSample> leaves = {leaf(0, 3, true, chair),
                                          leaf(1, 3, true, table),
                                          leaf(1, 5, true, chair),
                                          leaf(2, 3, true),
                                          leaf(3, 3, false),
                                          leaf(5, 3, false, chair),
                                          leaf(0, 40, true, ClassId{9})};  // above the band
  const HeightBand band{.min_m = 0.3, .max_m = 0.6};
  const auto grids = project_class_grids(source_of(leaves), band, {.min_free_share = 0.3});
  ASSERT_TRUE(grids);
  ASSERT_EQ(grids->size(), 2U);
  EXPECT_EQ((*grids)[0].id, table);
  EXPECT_THAT(cells((*grids)[0].grid), ElementsAre(0, 100, 0, 0, -1, 0));
  EXPECT_EQ((*grids)[1].id, chair);
  EXPECT_THAT(cells((*grids)[1].grid), ElementsAre(100, 100, 0, 0, -1, 0));
}

TEST(ClassGrids, NoClassGivesNoGrid) {
  const std::vector<LeafSample> leaves = {leaf(0, 3, true)};
  EXPECT_TRUE(project_class_grids(source_of(leaves))->empty());
}

TEST(ClassGrids, ShapesAreFilledRatherThanTheirBoxes) {
  const GridGeometry geometry{.resolution_m = 1.0, .cols = 4, .rows = 4};
  const Polygon triangle = *make_polygon({{0, 0}, {4, 0}, {0, 4}});
  // On or under the diagonal: 4 + 3 + 2 + 1 = 10 cells are met, 6 covered whole, 4 by half.
  EXPECT_EQ(fill_shapes(geometry, std::vector{triangle})->counts().occupied, 10U);
  EXPECT_EQ(fill_shapes(geometry, std::vector{triangle}, 0.5)->counts().occupied, 10U);
  EXPECT_EQ(fill_shapes(geometry, std::vector{triangle}, 0.51)->counts().occupied, 6U);
}

TEST(ClassGrids, ATurnedGridIsFilledWhereTheShapeIs) {
  const GridGeometry geometry{
      .resolution_m = 1.0, .yaw_rad = std::numbers::pi / 2, .cols = 2, .rows = 2};
  const Polygon square = *make_polygon({{-1, 1}, {0, 1}, {0, 2}, {-1, 2}});
  const auto grid = fill_shapes(geometry, std::vector{square}, 0.5);
  EXPECT_EQ(grid->at({1, 0}), 100);  // turned back by 90 degrees: x 1..2, y 0..1
  EXPECT_EQ(grid->counts().occupied, 1U);
}

TEST(ClassGrids, AShareOutsideItsRangeIsRefused) {
  EXPECT_EQ(fill_shapes({}, {}, 1.5).error().field, "min_covered");
}

}  // namespace
}  // namespace hypermap
