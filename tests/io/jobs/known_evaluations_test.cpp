// SPDX-License-Identifier: BSD-3-Clause
// The figures of [hypermap] 5.2.1 of maps that its first implementation recorded in the laboratory.
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <ostream>
#include <string>

namespace hypermap {
namespace {

constexpr const char* kLaboratoryTruth = "hmap/semantic_gt_2019-04-23-12-51-46.hmap";
constexpr double kTolerance = 0.002;

/// What `eval --map ... --truth ...` tells under `all`, of the truths whose class the map has.
struct KnownEvaluation {
  const char* name;
  const char* map;
  std::size_t num_judged;
  double jaccard;
  double distance_m;

  friend std::ostream& operator<<(std::ostream& out, const KnownEvaluation& known) {
    return out << known.map;
  }
};

class KnownEvaluations : public testing::TestWithParam<KnownEvaluation> {};

TEST_P(KnownEvaluations, TheThesisMetricIsWhatItWas) {
  const KnownEvaluation& known = GetParam();
  HYPERMAP_REQUIRE_SHARED_DATA(kLaboratoryTruth);
  HYPERMAP_REQUIRE_SHARED_DATA(known.map);
  const auto outcome = run_evaluation(
      {.map = test::shared_data(known.map), .truth = test::shared_data(kLaboratoryTruth)});
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  const NearestMetric& thesis = outcome->report.all.nearest;
  ASSERT_EQ(thesis.n, known.num_judged);
  EXPECT_EQ(thesis.num_truth, 28U);
  EXPECT_NEAR(*thesis.jaccard, known.jaccard, kTolerance);
  EXPECT_NEAR(*thesis.distance_m, known.distance_m, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    RecordedMaps,
    KnownEvaluations,
    testing::Values(
        KnownEvaluation{"T16", "hmap/map_t16.hmap", 20, 0.3635, 0.3921},
        KnownEvaluation{
            "T1Intersection", "hmap/lab_rosbag_t1_intersection.hmap", 15, 0.1439, 1.0894}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace hypermap
