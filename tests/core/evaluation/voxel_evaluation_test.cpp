// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/voxel_evaluation.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace hypermap {
namespace {

constexpr double kEdgeM = 0.1;
constexpr ClassId kSofa{0};
constexpr ClassId kChair{1};

ClassRegistry sofa_and_chair() {
  return ClassRegistry::from_names(std::vector<std::string>{"couch", "chair"}).value();
}

LeafSample voxel(double x, double y, double z, std::optional<ClassId> label) {
  return {.centre_in_map = {x, y, z}, .edge_m = kEdgeM, .occupied = true, .best_class = label};
}

LeafSource source_of(std::vector<LeafSample> leaves) {
  return [leaves = std::move(leaves)](const LeafVisitor& visit) {
    for (const LeafSample& leaf : leaves) visit(leaf);
  };
}

/// A square sheet on z = 0 from (x, 0) to (x + 1, 1).
TrueSurface sheet(std::uint32_t id, const std::string& name, float x) {
  return {.id = ObjectId{id},
          .class_name = name,
          .vertices = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

TEST(VoxelEvaluation, ByHand) {
  // A sofa on x = 0 .. 1, a chair on 1 .. 2, and a bin on 4 .. 5 that the detector cannot name.
  TrueSurfaces truth{.objects = {sheet(1, "sofa", 0), sheet(2, "chair", 1), sheet(3, "bin", 4)}};
  truth.objects[2].is_nameable = false;
  LeafSample free_space = voxel(0.55, 0.55, 0.05, kSofa);
  free_space.occupied = false;
  const auto leaves = source_of({
      voxel(0.25, 0.55, 0.05, kSofa),         // right
      voxel(0.35, 0.55, 0.05, kChair),        // 0.65 m from the chair: the wrong class
      voxel(0.45, 0.55, 0.05, std::nullopt),  // not labelled
      voxel(0.95, 0.55, 0.05, kChair),        // at both: right, though the sofa is nearer
      voxel(1.55, 0.55, 0.05, kChair),        // right
      voxel(1.55, 0.55, 0.15, kChair),        // 0.15 m above: at nothing
      voxel(3.05, 0.55, 0.05, kSofa),         // at nothing
      voxel(4.55, 0.55, 0.05, kSofa),         // at what cannot be named
      voxel(4.65, 0.55, 0.05, std::nullopt),  // the same, not labelled
      free_space,
  });
  const auto report = evaluate_voxels(leaves, sofa_and_chair(), truth).value();
  EXPECT_EQ(report.all.labelled, 7U);
  EXPECT_EQ(report.all.right, 3U);
  EXPECT_EQ(report.all.wrong_class, 1U);
  EXPECT_EQ(report.all.true_voxels, 5U);
  EXPECT_EQ(report.all.true_right, 3U);
  EXPECT_EQ(report.all.true_unlabelled, 1U);
  EXPECT_DOUBLE_EQ(*report.all.precision(), 3.0 / 7.0);
  EXPECT_DOUBLE_EQ(*report.all.recall(), 3.0 / 5.0);
  EXPECT_DOUBLE_EQ(*report.all.wrong_class_share(), 1.0 / 7.0);

  const ClassVoxelCounts& sofa = report.classes.at("sofa");
  EXPECT_DOUBLE_EQ(*sofa.precision(), 1.0 / 3.0);
  EXPECT_EQ(sofa.true_voxels, 4U);  // the one at both is nearer to the sofa
  EXPECT_DOUBLE_EQ(*sofa.recall(), 2.0 / 4.0);
  EXPECT_EQ(sofa.most_confused_for(), "chair");
  EXPECT_EQ(sofa.confused_for.at("chair"), 1U);
  EXPECT_EQ(sofa.true_unlabelled, 1U);
  const ClassVoxelCounts& chair = report.classes.at("chair");
  EXPECT_DOUBLE_EQ(*chair.precision(), 2.0 / 4.0);
  EXPECT_EQ(chair.wrong_class, 1U);
  EXPECT_DOUBLE_EQ(*chair.recall(), 1.0);
  EXPECT_FALSE(chair.most_confused_for());
  EXPECT_FALSE(report.classes.contains("bin"));
}

TEST(VoxelEvaluation, OneVoxelEdgeIsStillAtTheObject) {
  const TrueSurfaces truth{.objects = {sheet(1, "sofa", 0)}};
  const auto right = [&](double z) {
    return evaluate_voxels(source_of({voxel(0.5, 0.5, z, kSofa)}), sofa_and_chair(), truth)
        .value()
        .all.right;
  };
  EXPECT_EQ(right(0.1), 1U);
  EXPECT_EQ(right(-0.1), 1U);
  EXPECT_EQ(right(0.101), 0U);
}

TEST(VoxelEvaluation, NoVoxelsAndNoTruthHaveNoShares) {
  const auto nothing = evaluate_voxels(source_of({}), sofa_and_chair(), {}).value();
  EXPECT_FALSE(nothing.all.precision());
  EXPECT_FALSE(nothing.all.recall());
  EXPECT_FALSE(nothing.all.wrong_class_share());
  EXPECT_TRUE(nothing.classes.empty());
}

TEST(VoxelEvaluation, ManyTrianglesGiveWhatEveryPairWouldGive) {
  TrueSurfaces truth;
  for (std::uint32_t id = 1; id <= 6; ++id) {
    TrueSurface surface{.id = ObjectId{id}, .class_name = id % 2 == 0 ? "sofa" : "chair"};
    CounterRng random(7, id);
    for (std::uint32_t i = 0; i < 30; ++i) {
      surface.vertices.emplace_back(static_cast<float>(random.uniform(0, 2)),
                                    static_cast<float>(random.uniform(0, 2)),
                                    static_cast<float>(random.uniform(0, 2)));
    }
    for (std::uint32_t i = 0; i < 30; i += 3) surface.triangles.push_back({i, i + 1, i + 2});
    truth.objects.push_back(surface);
  }
  std::vector<LeafSample> leaves;
  CounterRng random(8, 1);
  std::size_t right = 0;
  for (int i = 0; i < 2000; ++i) {
    const ClassId label = random.chance(0.5) ? kSofa : kChair;
    leaves.push_back(voxel(0.05 + 0.1 * std::floor(random.uniform(0, 20)),
                           0.05 + 0.1 * std::floor(random.uniform(0, 20)),
                           0.05 + 0.1 * std::floor(random.uniform(0, 20)),
                           label));
    bool is_right = false;
    for (const TrueSurface& surface : truth.objects) {
      if ((surface.class_name == "sofa") != (label == kSofa)) continue;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const double distance2 =
            squared_distance(leaves.back().centre_in_map, triangle_at(surface, t));
        is_right = is_right || distance2 <= kEdgeM * kEdgeM;
      }
    }
    right += is_right ? 1U : 0U;
  }
  const auto report = evaluate_voxels(source_of(leaves), sofa_and_chair(), truth).value();
  EXPECT_GT(right, 100U);
  EXPECT_EQ(report.all.right, right);
}

TEST(VoxelEvaluation, CoverageIsTheShareOfSeenCellsNearOccupiedVoxels) {
  // Cells of 0.05 m, voxels of 0.1 m: a centre counts within 0.1 m. The voxel at (0.05, 0.05, 0.05)
  // is 0.043 m from the first cell's centre; the second's lies 0.3 m away.
  TrueSurfaces truth{.objects = {sheet(1, "sofa", 0), sheet(2, "chair", 1)}};
  truth.objects[0].seen_cells = {{0, 0, 0}, {7, 0, 0}};
  const auto coverage =
      evaluate_voxels(source_of({voxel(0.05, 0.05, 0.05, std::nullopt)}), sofa_and_chair(), truth)
          .value()
          .coverage;
  ASSERT_EQ(coverage.size(), 2U);
  EXPECT_EQ(coverage[0].seen_cells, 2U);
  EXPECT_EQ(coverage[0].covered_cells, 1U);
  EXPECT_DOUBLE_EQ(*coverage[0].share(), 0.5);
  EXPECT_FALSE(coverage[1].share());
}

TEST(VoxelEvaluation, ItEndsWhenItIsToldTo) {
  const TrueSurfaces truth{.objects = {sheet(1, "sofa", 0)}};
  const auto stopped = evaluate_voxels(
      source_of({voxel(0.5, 0.5, 0, kSofa)}), sofa_and_chair(), truth, [] { return true; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace hypermap
