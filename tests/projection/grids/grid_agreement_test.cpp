// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_agreement.hpp"

#include "drawn_plan.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace hypermap {
namespace {

using test::drawn_plan;

TEST(GridAgreement, CountsFreeCellsJustWhereTheyAre) {
  // Of the map's five free cells two are free in truth, two blocked, and of one nothing is known.
  const auto agreement =
      grid_agreement(drawn_plan({"..#..", "??.??"}), drawn_plan({".##.#", "..?#."}));
  EXPECT_EQ(agreement.free, 4U);
  EXPECT_EQ(agreement.free_right, 2U);
  EXPECT_EQ(agreement.free_precision(), 0.5);
  EXPECT_EQ(agreement.true_free, 5U);
  EXPECT_EQ(agreement.free_found, 2U);
  EXPECT_EQ(agreement.free_recall(), 0.4);
  EXPECT_EQ(agreement.true_occupied, 4U);
  EXPECT_EQ(agreement.occupied_free, 2U);
}

TEST(GridAgreement, AWallMayLieOnEitherSideOfAnEdge) {
  const auto agreement =
      grid_agreement(drawn_plan({"#....#", "......"}), drawn_plan({".#....", ".....#"}));
  EXPECT_EQ(agreement.occupied, 2U);
  EXPECT_EQ(agreement.occupied_right, 2U);
  EXPECT_EQ(agreement.occupied_found, 2U);
  const auto far = grid_agreement(drawn_plan({"#..."}), drawn_plan({"..#."}));
  EXPECT_EQ(far.occupied_precision(), 0.0);
  EXPECT_EQ(far.occupied_recall(), 0.0);
}

TEST(GridAgreement, FiftyPerCentIsBlocked) {
  OccupancyGrid map = drawn_plan({".."});
  map.set({0, 0}, 49);
  map.set({1, 0}, 50);
  const auto agreement = grid_agreement(map, drawn_plan({".."}));
  EXPECT_EQ(agreement.free, 1U);
  EXPECT_EQ(agreement.occupied, 1U);
}

TEST(GridAgreement, GridsOfOtherLatticesAreAskedAtTheMiddlesOfCells) {
  // A truth of half the edge, of which the left half is blocked; a map that begins beside it.
  const auto truth = drawn_plan({"##..", "##.."}, 0.5);
  const auto agreement = grid_agreement(drawn_plan({"..."}), truth);
  EXPECT_EQ(agreement.free, 2U) << "what lies beyond the truth is unknown";
  EXPECT_EQ(agreement.free_right, 1U);
  EXPECT_EQ(agreement.occupied_free, 4U);
}

TEST(GridAgreement, OfNothingThereIsNoShare) {
  const auto agreement = grid_agreement(OccupancyGrid(), OccupancyGrid());
  EXPECT_EQ(agreement.free_precision(), std::nullopt);
  EXPECT_EQ(agreement.free_recall(), std::nullopt);
  EXPECT_EQ(agreement.occupied_precision(), std::nullopt);
  EXPECT_EQ(agreement.occupied_recall(), std::nullopt);
}

}  // namespace
}  // namespace hypermap
