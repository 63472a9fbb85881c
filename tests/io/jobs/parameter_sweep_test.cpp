// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/parameter_sweep.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SweepAxis, IsAnOptionAndItsValues) {
  const SweepAxis axis = parse_sweep_axis("octree.resolution_m=0.05,0.1").value();
  EXPECT_EQ(axis, (SweepAxis{"octree.resolution_m", {"0.05", "0.1"}}));
  EXPECT_EQ(parse_sweep_axis("segmentation.policy=cluster").value().values,
            std::vector<std::string>{"cluster"});
}

TEST(SweepAxis, WhatIsNoOptionIsToldWithTheNearest) {
  EXPECT_THAT(parse_sweep_axis("octree.resolution=0.1").error().what, HasSubstr("resolution_m"));
  EXPECT_EQ(parse_sweep_axis("octree.resolution_m=0.1,-1").error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_THAT(parse_sweep_axis("octree.resolution_m=0.1,0.1").error().what, HasSubstr("twice"));
  for (const char* text : {"", "=1", "octree.resolution_m", "octree.resolution_m="}) {
    EXPECT_FALSE(parse_sweep_axis(text)) << text;
  }
}

TEST(SweepScores, MeanAndWorstAreOfTheRunsThatHaveAValue) {
  const std::vector<SweepScores> runs{
      {.f1 = 0.5, .recall = 1.0, .distance_m = 0.1}, {.f1 = 1.0, .distance_m = 0.3}, {.f1 = 0.75}};
  EXPECT_EQ(mean_of(runs), (SweepScores{.f1 = 0.75, .recall = 1.0, .distance_m = 0.2}));
  EXPECT_EQ(worst_of(runs), (SweepScores{.f1 = 0.5, .recall = 1.0, .distance_m = 0.3}));
  EXPECT_EQ(mean_of({}), SweepScores{});
}

/// What is detected once is an object: all points in its box.
MapOptions of_one_detection() {
  MapOptions options;
  GeometricSegmentationOptions& segmentation = options.mapper.objects.segmentation;
  segmentation.policy = SegmentationPolicy::kCluster;
  segmentation.leaf_size_m = 0.0;
  segmentation.outlier_neighbours = 0;
  segmentation.cluster_gap_m = 0.0;
  options = with_option(options, "publication.min_observations", "1").value();
  return with_option(options, "publication.min_real_probability", "none").value();
}

/// A small sequence with one chair, and the map with it as its truth.
class SweepTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(dir / "work");
    const test::SyntheticDataset data = test::write_tum(dir / "lab");
    job.options = of_one_detection();
    MappingJob mapping{.input = data.folder, .output = dir / "truth.hmap"};
    mapping.mapper = job.options.mapper;
    const auto mapped = run_mapping(mapping);
    ASSERT_TRUE(mapped) << to_string(mapped.error());
    ASSERT_EQ(mapped->num_objects, 1U);
    job.sequences = {{.name = "a", .input = data.folder, .truth = dir / "truth.hmap"},
                     {.name = "b", .input = data.folder, .truth = dir / "truth.hmap"}};
    job.folder = dir / "work";
  }

  [[nodiscard]] std::size_t num_left() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(dir / "work")) {
      count += entry.exists() ? 1U : 0U;
    }
    return count;
  }

  test::TempDir dir;
  SweepJob job;
};

TEST_F(SweepTest, EachCombinationIsMappedOnceForEachSequence) {
  job.axes = {{"octree.resolution_m", {"0.05", "0.1"}},
              {"absence.missed_decay", {"0.2", "0.4", "0.6"}}};
  std::size_t most = 0;
  const SweepReport report = run_sweep(job, [&](std::size_t done, std::size_t total) {
                               EXPECT_EQ(total, 12U);
                               most = std::max(most, done);
                               return true;
                             }).value();
  EXPECT_EQ(most, 12U);
  ASSERT_EQ(report.points.size(), 6U);
  EXPECT_THAT(report.points[1].values, ElementsAre("0.05", "0.4")) << "the last varies first";
  EXPECT_THAT(report.points[5].values, ElementsAre("0.1", "0.6"));
  EXPECT_THAT(report.sequences, ElementsAre("a", "b"));
  for (const SweepPoint& point : report.points) {
    ASSERT_EQ(point.runs.size(), 2U);
    EXPECT_EQ(point.runs[0], point.runs[1]) << "the same sequence";
  }
  EXPECT_EQ(num_left(), 0U);
  const auto json = JsonDocument::parse(to_json(report), "sweep").value();
  EXPECT_EQ(json.root().find("points")->size(), 6U);
  EXPECT_EQ(json.root().find("axes")->at(1).find("values")->size(), 3U);
}

TEST_F(SweepTest, AnOptionThatLosesTheObjectCostsTheRecall) {
  job.axes = {{"publication.min_observations", {"1", "2"}}};
  const SweepReport report = run_sweep(job).value();
  EXPECT_EQ(report.points[0].mean.f1, 1.0);
  EXPECT_EQ(report.points[0].worst.recall, 1.0);
  EXPECT_EQ(report.points[0].mean.distance_m, 0.0);
  EXPECT_EQ(report.points[1].mean.recall, 0.0) << "seen once, and two are asked";
  EXPECT_FALSE(report.points[1].mean.precision) << "the map has no object";
}

TEST_F(SweepTest, WhatCannotBeSweptIsRefusedBeforeTheFirstMap) {
  const auto refused = [&](std::vector<SweepAxis> axes) {
    job.axes = std::move(axes);
    return run_sweep(job,
                     [](std::size_t, std::size_t) {
                       ADD_FAILURE() << "a map was begun";
                       return false;
                     })
        .error();
  };
  EXPECT_EQ(refused({}).field, "axes");
  EXPECT_THAT(refused({{"octree.resolution_m", {"0.1", "-1"}}}).what,
              HasSubstr("octree.resolution_m=-1"));
  EXPECT_THAT(refused({{"octree.resolution_m", {"1"}}, {"octree.resolution_m", {"2"}}}).what,
              HasSubstr("twice"));
  EXPECT_EQ(refused({{"prior.num_layers", {"1", "2"}}}).field, "prior.num_layers");
  EXPECT_EQ(refused({{"absence.missed_decay", std::vector<std::string>(6000, "1")}}).field, "axes");
}

TEST_F(SweepTest, PlacesAndACombinerGoWithTheOptionsThatNeedThem) {
  job.axes = {{"prior.source", {"none", "places"}}};
  const auto refused = run_sweep(job);
  EXPECT_EQ(refused.error().field, "prior.source");
  EXPECT_THAT(refused.error().what, HasSubstr("with prior.source=places"));
  job.place_rules.emplace();
  job.place_rules->belongings = {{"chair", {{"kitchen", 2.0}}}};
  job.place_rules->places = {"kitchen"};
  const auto swept = run_sweep(job);
  ASSERT_TRUE(swept) << to_string(swept.error());
  EXPECT_EQ(swept->points[0].mean, swept->points[1].mean) << "one chair, whatever stands around";
  job.axes = {{"stacking.rule", {"sum", "trained"}}};
  EXPECT_EQ(run_sweep(job).error().field, "stacking.rule");
  job.combiner = dir / "combiner.json";
  test::write_text(*job.combiner, "{}");
  EXPECT_THAT(run_sweep(job).error().what, HasSubstr("with stacking.rule=trained"))
      << "the combination without it is mapped, the one with it reads the file";
  EXPECT_EQ(num_left(), 0U);
}

TEST_F(SweepTest, AnInterruptionLeavesNoMap) {
  job.axes = {{"octree.resolution_m", {"0.05", "0.1"}}};
  const auto ended =
      run_sweep(job, [](std::size_t done, std::size_t /*total*/) { return done < 1; });
  EXPECT_EQ(ended.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(num_left(), 0U);
}

}  // namespace
}  // namespace hypermap
