// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/leaf_evidence.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/projection/grids/class_grids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;

constexpr ClassId kChair{3};
constexpr ClassId kTable{1};
constexpr double kEdge = 0.1;

LeafSample leaf_at(int x, int z, double occupancy) {
  return {.centre_in_map = kEdge * Eigen::Vector3d(x + 0.5, 0.5, z + 0.5),
          .edge_m = kEdge,
          .occupancy = LogOdds(occupancy),
          .occupied = occupancy > 0.0};
}

LeafSample leaf_of_class(int x, int z, ClassId id, double class_log_odds) {
  LeafSample leaf = leaf_at(x, z, 3.5);
  leaf.best_class = id;
  leaf.class_log_odds = LogOdds(class_log_odds);
  return leaf;
}

LeafSource visiting(const std::vector<LeafSample>& leaves) {
  return [&leaves](const LeafVisitor& visit) {
    for (const LeafSample& sample : leaves) visit(sample);
  };
}

constexpr HeightBand kBand{.min_m = 0.3, .max_m = 0.6};

TEST(ClassEvidence, IsTheSumOverTheVoxelsOfAColumn) {
  // Column 0: two voxels of a chair, 1.5 + 0.7. Column 1: a table, 2.0, under a chair, 0.4. Column
  // 2: something without a class, 3.5. Column 3: free twice, -2 - 1. Column 4: free once of three,
  // too little. Column 5: a chair above the band alone.
  const std::vector<LeafSample> leaves{leaf_of_class(0, 3, kChair, 1.5),
                                       leaf_of_class(0, 4, kChair, 0.7),
                                       leaf_of_class(1, 3, kTable, 2.0),
                                       leaf_of_class(1, 4, kChair, 0.4),
                                       leaf_at(2, 5, 3.5),
                                       leaf_at(3, 3, -2.0),
                                       leaf_at(3, 4, -1.0),
                                       leaf_at(4, 3, -2.0),
                                       leaf_of_class(5, 7, kChair, 1.0)};
  const auto grids = project_class_evidence(visiting(leaves), kBand);
  ASSERT_TRUE(grids);
  ASSERT_EQ(grids->size(), 2U);
  EXPECT_EQ(grids->front().id, kTable);
  EXPECT_THAT(grids->front().grid.cells(), ElementsAre(-2200, 2000, -3500, -3000, 0));
  EXPECT_EQ(grids->back().id, kChair);
  EXPECT_THAT(grids->back().grid.cells(), ElementsAre(2200, 400, -3500, -3000, 0));
}

TEST(ClassEvidence, IsRelativeToWhatIsLikelyBefore) {
  // [smap] Eq. (3.18): of 80 classes one of p = 0.39 says ln(0.39 / 0.61) + ln 79 = -0.4473 +
  // 4.3694 = 3.9221 for it; of two, -0.4473.
  const std::vector<LeafSample> leaves{leaf_of_class(0, 3, kChair, std::log(0.39 / 0.61)),
                                       leaf_of_class(1, 3, kTable, 0.0)};
  const auto of_80 = project_class_evidence(visiting(leaves), kBand, {}, 80).value();
  EXPECT_THAT(of_80.back().grid.cells(), ElementsAre(3922, -4369));
  for (const std::size_t few : {0U, 1U, 2U}) {
    const auto of_few = project_class_evidence(visiting(leaves), kBand, {}, few).value();
    EXPECT_THAT(of_few.back().grid.cells(), ElementsAre(-447, 0));
  }
}

TEST(ClassEvidence, CountsVoxelsHoweverLeavesJoinThem) {
  // A leaf of 0.2 m is eight voxels, two in each of four columns; so is each half of it in z.
  LeafSample joined = leaf_of_class(0, 3, kChair, 1.0);
  joined.edge_m = 2 * kEdge;
  joined.centre_in_map = {0.1, 0.1, 0.5};
  std::vector<LeafSample> leaves{joined, leaf_of_class(5, 4, kTable, 1.0)};
  const auto of_joined = project_class_evidence(visiting(leaves), kBand).value();
  leaves.erase(leaves.begin());
  for (const int z : {4, 5}) {
    for (const double y : {0.05, 0.15}) {
      for (const int x : {0, 1}) {
        leaves.push_back(leaf_of_class(x, z, kChair, 1.0));
        leaves.back().centre_in_map.y() = y;
      }
    }
  }
  const auto of_voxels = project_class_evidence(visiting(leaves), kBand).value();
  ASSERT_EQ(of_joined.size(), 2U);
  EXPECT_EQ(of_joined.back().grid.at({1, 1}), 2000);
  EXPECT_EQ(of_joined.back().grid, of_voxels.back().grid);
  EXPECT_EQ(of_joined.front().grid, of_voxels.front().grid);
}

TEST(ClassEvidence, HasTheSignsOfTheClassGrids) {
  CounterRng random(11, 4);
  std::vector<LeafSample> leaves;
  for (int x = 0; x < 60; ++x) {
    for (int z = 2; z < 8; ++z) {
      if (random.chance(0.3)) continue;
      if (random.chance(0.5)) {
        leaves.push_back(leaf_at(x, z, random.uniform(-3.0, -0.1)));
      } else if (random.chance(0.3)) {
        leaves.push_back(leaf_at(x, z, random.uniform(0.1, 3.0)));
      } else {
        const ClassId id{random.below(4)};
        leaves.push_back(leaf_of_class(x, z, id, random.uniform(0.1, 3.0)));
      }
    }
  }
  const auto evidence = project_class_evidence(visiting(leaves), kBand).value();
  const auto classes = project_class_grids(visiting(leaves), kBand).value();
  ASSERT_EQ(evidence.size(), classes.size());
  ASSERT_EQ(evidence.size(), 4U);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    EXPECT_EQ(evidence[k].id, classes[k].id);
    const auto is_state_of = [](LogOddsSteps steps, std::int8_t cell) {
      if (cell == kUnknownCell) return steps == 0;
      return cell == kOccupiedCell ? steps > 0 : steps < 0;
    };
    EXPECT_TRUE(std::ranges::equal(evidence[k].grid.cells(), classes[k].grid.cells(), is_state_of));
  }
}

TEST(ClassEvidence, ACellHasTheShareThatALeafCoversOfIt) {
  // Cells of 0.2 m: a voxel of 0.1 m is a quarter of its cell.
  const std::vector<LeafSample> leaves{leaf_of_class(0, 3, kChair, 2.0)};
  const auto grids = project_class_evidence(visiting(leaves), kBand, {.resolution_m = 0.2});
  ASSERT_TRUE(grids);
  EXPECT_THAT(grids->front().grid.cells(), ElementsAre(500));
}

TEST(ClassEvidence, AMapWithoutClassesGivesNone) {
  const std::vector<LeafSample> leaves{leaf_at(0, 3, 3.0), leaf_at(1, 3, -3.0)};
  EXPECT_TRUE(project_class_evidence(visiting(leaves), kBand).value().empty());
  EXPECT_TRUE(project_class_evidence(visiting({}), kBand).value().empty());
  EXPECT_EQ(project_class_evidence(visiting(leaves), {.min_m = 1.0, .max_m = 0.0}).error().field,
            "height_band");
}

}  // namespace
}  // namespace hypermap
