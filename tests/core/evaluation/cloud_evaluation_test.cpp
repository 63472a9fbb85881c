// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/cloud_evaluation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kVoxelM = 0.1;
constexpr std::uint32_t kSofaPoint = 0;
constexpr std::uint32_t kChairPoint = 1;
constexpr std::uint32_t kPointOfNone = TrueCloud::kNoTrueClass;

/// Ids 0 and 1.
ClassRegistry couch_and_chair() {
  return ClassRegistry::from_names(std::vector<std::string>{"couch", "chair"}).value();
}

LeafSample cube(double x, double z, std::optional<ClassId> label) {
  return {.centre_in_map = {x, 0.55, z}, .edge_m = kVoxelM, .occupied = true, .best_class = label};
}

LeafSource leaves_of(std::vector<LeafSample> leaves) {
  return [leaves = std::move(leaves)](const LeafVisitor& visit) {
    for (const LeafSample& leaf : leaves) visit(leaf);
  };
}

TEST(CloudEvaluation, ByHand) {
  const ClassId couch{0};
  const ClassId chair{1};
  const TrueCloud cloud{
      .points = {{0.25F, 0.55F, 0.05F},
                 {0.45F, 0.55F, 0.05F},
                 {1.55F, 0.55F, 0.05F},
                 {1.55F, 0.55F, 0.45F},
                 {4.55F, 0.55F, -0.04F}},
      .class_of_point = {kSofaPoint, kSofaPoint, kChairPoint, kChairPoint, kPointOfNone},
      .class_names = {"sofa", "chair"}};
  ASSERT_TRUE(validate(cloud));
  LeafSample free_space = cube(0.55, 0.05, couch);
  free_space.occupied = false;
  const auto leaves = leaves_of({cube(0.25, 0.05, couch),         // right
                                 cube(0.35, 0.05, chair),         // one edge from two sofa points
                                 cube(0.45, 0.05, std::nullopt),  // not labelled
                                 cube(1.55, 0.05, chair),         // right
                                 cube(1.55, 0.25, chair),         // 0.2 m from any point
                                 cube(4.55, 0.05, couch),         // at a point without a class
                                 free_space});
  const auto evaluation = evaluate_cloud(leaves, couch_and_chair(), cloud).value();
  EXPECT_EQ(evaluation.all.labelled, 5U);
  EXPECT_EQ(evaluation.all.right, 2U);
  EXPECT_EQ(evaluation.all.wrong_class, 1U);
  EXPECT_EQ(evaluation.all.true_voxels, 4U);
  EXPECT_EQ(evaluation.all.true_right, 2U);
  EXPECT_EQ(evaluation.all.true_unlabelled, 1U);
  EXPECT_EQ(evaluation.labelled_off_cloud, 1U);
  EXPECT_DOUBLE_EQ(*evaluation.all.precision(), 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(*evaluation.precision_at_cloud(), 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(*evaluation.all.recall(), 2.0 / 4.0);
  // A couch is a sofa.
  const ClassVoxelCounts& sofa = evaluation.classes.at("sofa");
  EXPECT_DOUBLE_EQ(*sofa.precision(), 1.0 / 2.0);
  EXPECT_DOUBLE_EQ(*sofa.recall(), 1.0 / 3.0);
  EXPECT_EQ(sofa.most_confused_for(), "chair");
  EXPECT_DOUBLE_EQ(*evaluation.classes.at("chair").precision(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(*evaluation.classes.at("chair").recall(), 1.0);

  // Cells of the five points; that of the upper chair point is 0.17 m and more from any voxel.
  EXPECT_DOUBLE_EQ(*evaluation.coverage.share(), 4.0 / 5.0);
  EXPECT_DOUBLE_EQ(*evaluation.coverage_of_class.at("sofa").share(), 1.0);
  EXPECT_DOUBLE_EQ(*evaluation.coverage_of_class.at("chair").share(), 1.0 / 2.0);
  EXPECT_EQ(evaluation.num_points, 5U);
  EXPECT_EQ(evaluation.num_without_class, 1U);
  // 0, 0 and 0 within voxels, 0.45 - 0.3 above one, 0.04 below one.
  ASSERT_TRUE(evaluation.distances);
  EXPECT_EQ(evaluation.distances->n, 5U);
  EXPECT_NEAR(evaluation.distances->mean_m, 0.19 / 5.0, 1e-7);
  EXPECT_NEAR(evaluation.distances->median_m, 0.0, 1e-7);
  EXPECT_NEAR(evaluation.distances->upper_m, 0.15, 1e-7);
  EXPECT_NEAR(evaluation.distances->max_m, 0.15, 1e-7);
}

TEST(CloudEvaluation, OfNothingIsNothing) {
  const auto empty = evaluate_cloud(leaves_of({}), {}, {}).value();
  EXPECT_FALSE(empty.all.precision());
  EXPECT_FALSE(empty.precision_at_cloud());
  EXPECT_FALSE(empty.coverage.share());
  EXPECT_FALSE(empty.distances);
  const TrueCloud point{.points = {{0, 0, 0}}, .class_of_point = {0}, .class_names = {"chair"}};
  const auto unmapped = evaluate_cloud(leaves_of({}), {}, point).value();
  EXPECT_DOUBLE_EQ(*unmapped.coverage.share(), 0.0);
  EXPECT_FALSE(unmapped.distances);
  const auto unseen =
      evaluate_cloud(leaves_of({cube(0.05, 0.05, ClassId{0})}), couch_and_chair(), {}).value();
  EXPECT_EQ(unseen.labelled_off_cloud, 1U);
  EXPECT_DOUBLE_EQ(*unseen.all.precision(), 0.0);
  EXPECT_FALSE(unseen.precision_at_cloud());
}

TEST(CloudEvaluation, EndsWhenItIsToldTo) {
  const TrueCloud point{.points = {{0, 0, 0}}, .class_of_point = {0}, .class_names = {"chair"}};
  const auto stopped = evaluate_cloud(
      leaves_of({cube(0.05, 0.05, ClassId{0})}), couch_and_chair(), point, [] { return true; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

TEST(CloudEvaluation, ACloudMustBeWhole) {
  const TrueCloud good{.points = {{0, 0, 0}}, .class_of_point = {0}, .class_names = {"chair"}};
  EXPECT_TRUE(validate(good));
  for (const auto& [change, field] : std::vector<std::pair<void (*)(TrueCloud&), std::string>>{
           {[](TrueCloud& cloud) { cloud.class_of_point.clear(); }, "class_of_point"},
           {[](TrueCloud& cloud) { cloud.class_of_point = {1}; }, "class_of_point"},
           {[](TrueCloud& cloud) { cloud.class_names = {" "}; }, "class_names"},
           {[](TrueCloud& cloud) { cloud.points[0].x() = NAN; }, "points"},
           {[](TrueCloud& cloud) { cloud.points[0].z() = 2e6F; }, "points"}}) {
    TrueCloud cloud = good;
    change(cloud);
    const auto valid = validate(cloud);
    ASSERT_FALSE(valid) << field;
    EXPECT_EQ(valid.error().field, field);
  }
}

/// What a search over all pairs says.
struct BruteForce {
  std::size_t right = 0;
  std::size_t off_cloud = 0;
  double mean_m = 0.0;
  double max_m = 0.0;
};

BruteForce brute_force(const std::vector<LeafSample>& leaves, const TrueCloud& cloud) {
  BruteForce all;
  for (const LeafSample& leaf : leaves) {
    bool is_near = false;
    bool is_right = false;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      const double far_m = (cloud.points[i].cast<double>() - leaf.centre_in_map).norm();
      if (far_m > leaf.edge_m * (1.0 + 1e-6)) continue;
      is_near = true;
      is_right = is_right || leaf.best_class == ClassId{cloud.class_of_point[i]};
    }
    all.off_cloud += is_near ? 0U : 1U;
    all.right += is_right ? 1U : 0U;
  }
  for (const Eigen::Vector3f& point : cloud.points) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const LeafSample& leaf : leaves) {
      const Eigen::Array3d beyond =
          (point.cast<double>() - leaf.centre_in_map).array().abs() - 0.5 * leaf.edge_m;
      least_m = std::min(least_m, beyond.max(0.0).matrix().norm());
    }
    all.mean_m += least_m / static_cast<double>(cloud.points.size());
    all.max_m = std::max(all.max_m, least_m);
  }
  return all;
}

TEST(CloudEvaluation, AgreesWithASearchOverAllPairs) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0.0F, 1.5F);
  std::uniform_int_distribution<int> cell(0, 14);
  std::uniform_int_distribution<std::uint32_t> label(0, 1);
  for (int round = 0; round < 20; ++round) {
    TrueCloud cloud{.class_names = {"couch", "chair"}};
    for (int i = 0; i < 150; ++i) {
      cloud.points.emplace_back(place(random), place(random), place(random));
      cloud.class_of_point.push_back(label(random));
    }
    std::vector<LeafSample> leaves;
    for (int i = 0; i < 200; ++i) {
      const auto middle = [&] { return kVoxelM * (cell(random) + 0.5); };
      leaves.push_back({.centre_in_map = {middle(), middle(), middle()},
                        .edge_m = kVoxelM,
                        .occupied = true,
                        .best_class = ClassId{label(random)}});
    }
    const BruteForce expected = brute_force(leaves, cloud);
    const auto evaluation = evaluate_cloud(leaves_of(leaves), couch_and_chair(), cloud).value();
    EXPECT_EQ(evaluation.all.right, expected.right);
    EXPECT_EQ(evaluation.labelled_off_cloud, expected.off_cloud);
    EXPECT_NEAR(evaluation.distances->mean_m, expected.mean_m, 1e-12);
    EXPECT_NEAR(evaluation.distances->max_m, expected.max_m, 1e-12);
  }
}

}  // namespace
}  // namespace hypermap
