// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/compared_plan.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// A square of half a metre about (x, 0).
EvaluatedObject object_at(const std::string& class_name, double x, bool excluded = false) {
  return {
      .class_name = class_name,
      .centroid = {x, 0},
      .footprint =
          make_polygon({{x - 0.25, -0.25}, {x + 0.25, -0.25}, {x + 0.25, 0.25}, {x - 0.25, 0.25}})
              .value(),
      .excluded = excluded,
      .size_m = 0.5};
}

TEST(ComparedPlan, EveryShapeHasItsFate) {
  const std::vector<EvaluatedObject> truth{object_at("chair", 0),
                                           object_at("chair", 5),
                                           object_at("lamp", 10, true),
                                           object_at("table", 20)};
  const std::vector<std::uint64_t> truth_ids{3, 4, 5, 6};
  const std::vector<EvaluatedObject> map{object_at("chair", 0.3),  // the second at the first chair
                                         object_at("Chair", 0.1),  // the nearest to it
                                         object_at("lamp", 10.1),  // at what does not count
                                         object_at("table", 30)};  // at nothing
  const std::vector<std::uint64_t> map_ids{11, 12, 13, 14};
  const ComparedPlan plan =
      compared_plan({map, map_ids}, {truth, truth_ids}, evaluate(map, truth), {});
  ASSERT_EQ(plan.truths.size(), 4U);
  EXPECT_EQ(plan.truths[0].fate, ComparedFate::kMatched);
  EXPECT_EQ(plan.truths[0].partner, 1U);
  EXPECT_EQ(plan.truths[1].fate, ComparedFate::kMissed);
  EXPECT_EQ(plan.truths[1].id, 4U);
  EXPECT_FALSE(plan.truths[1].partner);
  EXPECT_EQ(plan.truths[2].fate, ComparedFate::kApart);
  EXPECT_EQ(plan.truths[3].fate, ComparedFate::kMissed);
  ASSERT_EQ(plan.objects.size(), 4U);
  EXPECT_EQ(plan.objects[0].fate, ComparedFate::kDuplicate);
  EXPECT_EQ(plan.objects[1].fate, ComparedFate::kMatched);
  EXPECT_EQ(plan.objects[1].partner, 0U);
  EXPECT_EQ(plan.objects[1].id, 12U);
  EXPECT_EQ(plan.objects[2].fate, ComparedFate::kApart);
  EXPECT_EQ(plan.objects[3].fate, ComparedFate::kFalse);
  EXPECT_EQ(plan.objects[3].footprint, map[3].footprint);
  EXPECT_EQ(num_of(plan.truths, ComparedFate::kMissed), 2U);
  EXPECT_EQ(num_of(plan.objects, ComparedFate::kMissed), 0U);
}

TEST(ComparedPlan, OnlyClassesThatWereComparedAreInIt) {
  const std::vector<EvaluatedObject> objects{object_at("chair", 0), object_at("table", 5)};
  const std::vector<std::uint64_t> ids{1, 2};
  const EvaluationOptions chairs{.classes = {"chair"}};
  const ComparedPlan plan =
      compared_plan({objects, ids}, {objects, ids}, evaluate(objects, objects, chairs), chairs);
  ASSERT_EQ(plan.truths.size(), 1U);
  ASSERT_EQ(plan.objects.size(), 1U);
  EXPECT_EQ(plan.objects[0].class_name, "chair");
}

}  // namespace
}  // namespace hypermap
