// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/evaluation_job.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Squares of half a metre, a chair each, their lower left corners at these x.
SemanticLayer chairs_at(const std::vector<double>& places) {
  SemanticLayer layer;
  for (const double x : places) {
    const Polygon square = make_polygon({{x, 0}, {x + 0.5, 0}, {x + 0.5, 0.5}, {x, 0.5}}).value();
    EXPECT_TRUE(layer.add({.id = layer.next_id(), .name = "chair", .parts = {square}}));
  }
  return layer;
}

class EvaluationJobTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path saved(const std::string& name,
                                            LayerContent content,
                                            const std::string& frame_id = "map") const {
    MapArchive archive;
    EXPECT_TRUE(archive.hypermap.add_layer(
        {{.name = "semantic", .frame_id = frame_id}, std::move(content)}));
    EXPECT_TRUE(save_archive(archive, dir / name));
    return dir / name;
  }

  test::TempDir dir;
};

TEST_F(EvaluationJobTest, TwoArchivesAreComparedWithAThird) {
  const auto truth = saved("truth.hmap", chairs_at({0, 2, 4}));
  const auto near = saved("near.hmap", chairs_at({0.1, 2.1}));
  const auto far = saved("far.hmap", chairs_at({0.2, 2.2, 4.2}));
  const auto outcome = run_evaluation({.map = near, .truth = truth, .against = far}).value();
  EXPECT_DOUBLE_EQ(*outcome.report.all.one_to_one.precision, 1.0);
  EXPECT_DOUBLE_EQ(*outcome.report.all.one_to_one.recall, 2.0 / 3.0);
  EXPECT_NEAR(*outcome.report.all.one_to_one.distance_m, 0.1, 1e-9);
  ASSERT_TRUE(outcome.against);
  // The third truth lies 1.9 m from the near map's second chair, 0.2 m from the far map's third.
  // Differences of distance 0.1, 0.1 and -1.7: the positive ones share the ranks 1 and 2.
  EXPECT_NEAR(outcome.against->distance.rank_sum, 3.0, 1e-9);
  EXPECT_FALSE(run_evaluation({.map = near, .truth = truth}).value().against);
}

TEST_F(EvaluationJobTest, AClassThatNeitherHasIsNotFound) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const EvaluationJob job{.map = truth, .truth = truth, .options = {.classes = {"chiar"}}};
  const auto refused = run_evaluation(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(refused.error().field, "classes");
}

TEST_F(EvaluationJobTest, ALayerOfAnotherFrameThanTheTruthIsRefused) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const auto moved = saved("moved.hmap", chairs_at({0}), "lab");
  for (const EvaluationJob& job : {EvaluationJob{.map = moved, .truth = truth},
                                   EvaluationJob{.map = truth, .truth = truth, .against = moved}}) {
    const auto refused = run_evaluation(job);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
    EXPECT_EQ(refused.error().file, moved.string());
    EXPECT_EQ(refused.error().what, "is in frame lab, must be in that of the truth: map");
  }
  EXPECT_TRUE(run_evaluation({.map = moved, .truth = moved}));
}

TEST_F(EvaluationJobTest, ALayerMustBeThereAndHaveShapes) {
  const auto truth = saved("truth.hmap", chairs_at({0}));
  const GridGeometry one_cell{.resolution_m = 0.05, .cols = 1, .rows = 1};
  const auto grid =
      saved("grid.hmap",
            OccupancyLayer(OccupancyGrid::create(one_cell, std::vector<std::int8_t>{0}).value()));
  const auto absent = run_evaluation({.map = truth, .truth = truth, .layer = "smells"});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(absent.error().file, truth.string());
  const auto flat = run_evaluation({.map = grid, .truth = truth});
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(flat.error().file, grid.string());
}

TEST_F(EvaluationJobTest, BadOptionsAreSaidFirst) {
  const auto refused =
      run_evaluation({.map = "absent", .truth = "absent", .options = {.gate_m = 0.0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
