// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/cloud_evaluation_job.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// A map of three voxels of 0.1 m in a row along x from 0 on, at y = z = 0.05: a couch, another one
/// and one without a class.
MapArchive three_voxels() {
  MapArchive archive;
  const ClassId couch = archive.classes.add("couch").value();
  archive.octree = SemanticOctree::create({.resolution_m = 0.1}).value();
  const VoxelGrid& grid = archive.octree->grid();
  VoxelLabel label;
  label.classes[0] = {.class_id = static_cast<std::uint16_t>(couch.value), .log_odds = 1000};
  for (const auto& [x, is_couch] : {std::pair(0.05, true), {0.15, true}, {0.25, false}}) {
    EXPECT_TRUE(archive.octree->set_leaf({.key = *grid.key({{x, 0.05, 0.05}}),
                                          .log_odds = 1000,
                                          .label = is_couch ? label : VoxelLabel{}}));
  }
  return archive;
}

class CloudEvaluationJobTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(save_archive(three_voxels(), dir / "map.hmap"));
    test::write_text(dir / "names.yaml", "3: sofa\n4: chair\n0: ~\n");
  }

  /// Points x, 0.05, 0.05 with these labels.
  [[nodiscard]] std::filesystem::path cloud(
      const std::vector<std::pair<double, int>>& points) const {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n"
                       "property int label\nend_header\n";
    for (const auto& [x, label] : points)
      text += std::to_string(x) + " 0.05 0.05 " + std::to_string(label) + "\n";
    test::write_text(dir / "cloud.ply", text);
    return dir / "cloud.ply";
  }

  test::TempDir dir;
};

// At the first voxel a sofa, at the third a chair; the second is an edge from both.
TEST_F(CloudEvaluationJobTest, LabelsMeanWhatTheFileSays) {
  const auto outcome = run_cloud_evaluation({.map = dir / "map.hmap",
                                             .cloud = cloud({{0.05, 3}, {0.25, 4}, {9.0, 0}}),
                                             .label_names = dir / "names.yaml"});
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  const CloudEvaluation& evaluation = outcome->evaluation;
  EXPECT_EQ(evaluation.all.labelled, 2U);
  EXPECT_EQ(evaluation.all.right, 2U);
  EXPECT_EQ(evaluation.all.true_voxels, 3U);
  EXPECT_EQ(evaluation.all.true_right, 2U);
  EXPECT_EQ(evaluation.all.true_unlabelled, 1U);
  EXPECT_EQ(evaluation.num_without_class, 1U);
  EXPECT_NEAR(evaluation.distances->max_m, 8.7, 1e-6);
}

TEST_F(CloudEvaluationJobTest, ACloudIsMovedIntoTheMap) {
  CloudEvaluationJob job{.map = dir / "map.hmap",
                         .cloud = cloud({{-0.95, 3}, {-0.85, 3}, {-0.75, 3}}),
                         .label_names = dir / "names.yaml"};
  EXPECT_EQ(run_cloud_evaluation(job).value().evaluation.all.right, 0U);
  job.map_from_cloud = MapFromInput(Eigen::Isometry3d(Eigen::Translation3d(1.0, 0, 0)));
  const CloudEvaluation moved = run_cloud_evaluation(job).value().evaluation;
  EXPECT_EQ(moved.all.right, 2U);
  EXPECT_NEAR(moved.distances->max_m, 0.0, 1e-6);
}

TEST_F(CloudEvaluationJobTest, NamesOfTheCloudItselfAndOfAVocabulary) {
  test::write_text(dir / "own.ply",
                   "ply\nformat ascii 1.0\ncomment label 9 settee\nelement vertex 1\n"
                   "property float x\nproperty float y\nproperty float z\n"
                   "property uchar label\nend_header\n0.05 0.05 0.05 9\n");
  CloudEvaluationJob job{.map = dir / "map.hmap", .cloud = dir / "own.ply"};
  EXPECT_EQ(run_cloud_evaluation(job).value().evaluation.all.right, 0U);
  job.vocabulary =
      ClassVocabulary::create({.aliases = {{{"sofa"}, {{"settee"}}}}, .super_classes = {}}).value();
  EXPECT_EQ(run_cloud_evaluation(job).value().evaluation.all.right, 2U);
}

TEST_F(CloudEvaluationJobTest, WhatIsMissingIsSaid) {
  const auto refusal = [](const CloudEvaluationJob& job) {
    const auto outcome = run_cloud_evaluation(job);
    return outcome ? "none" : to_string(outcome.error());
  };
  CloudEvaluationJob job{.map = dir / "map.hmap", .cloud = cloud({{0.05, 3}})};
  EXPECT_THAT(refusal(job), testing::HasSubstr("labels: has labels without names"));
  job.label_names = dir / "names.yaml";
  job.cloud = cloud({{0.05, 5}});
  EXPECT_THAT(refusal(job), testing::HasSubstr("labels: bears none of the labels that are named"));
  job.cloud = cloud({});
  EXPECT_THAT(refusal(job), testing::HasSubstr("points: has no measured point"));
  test::write_text(dir / "bare.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                   "property float z\nend_header\n1 2 3\n");
  job.cloud = dir / "bare.ply";
  EXPECT_THAT(refusal(job), testing::HasSubstr("fields: has no field label"));
  ASSERT_TRUE(save_archive(MapArchive(), dir / "empty.hmap"));
  job.map = dir / "empty.hmap";
  job.cloud = cloud({{0.05, 3}});
  EXPECT_THAT(refusal(job), testing::HasSubstr("octree: has no octree"));
}

}  // namespace
}  // namespace hypermap
