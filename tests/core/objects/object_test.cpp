// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

constexpr ClassId kObservedClass{3};

Object object_of(const Box& box, ClassId id = kObservedClass) {
  return make_object(observed(surface_of(box), scores(id, 0.8)), {});
}

TEST(Object, ConfidenceIsTheWeightedSumOfThreeTerms) {
  // [smap] Eq. (3.27), table D.2: tp1 = 0.9, tp2 = 0.6, tp3 = 2/3:
  // (4 * 0.9 + 0.6 + 0.6666667) / 6 = 0.8111111; multiplied: 2/3 (4 * 0.9 + 0.6) / 5 = 0.56.
  Object object;
  object.belief =
      ClassBelief::from_entries({}, {{kObservedClass, LogOdds::of(Probability(0.9))}}).value();
  object.box_confidence = LogOdds::of(Probability(0.6));
  std::vector<LogOdds> bins(18);
  bins[0] = bins[1] = LogOdds(2.0);
  bins[9] = LogOdds(-2.0);
  object.histogram = VisibilityHistogram::from_bins({}, bins).value();
  EXPECT_NEAR(object_confidence(object, {ConfidenceRule::kWeighted}).value(), 0.8111111, 1e-7);
  EXPECT_NEAR(object_confidence(object, {ConfidenceRule::kMultiplied}).value(), 0.56, 1e-12);
}

TEST(Object, NothingIsKnownOfAnEmptyOne) {
  EXPECT_FALSE(best_class(Object{}).has_value());
  EXPECT_NEAR(object_confidence(Object{}, {ConfidenceRule::kWeighted}).value(), 1.5 / 6.0, 1e-12);
  for (const auto policy : {ShapePolicy::kBest, ShapePolicy::kHull, ShapePolicy::kVoxels}) {
    EXPECT_EQ(footprint(Object{}, policy).error().code, ErrorCode::kNotFound);
  }
}

TEST(Object, AllShapePoliciesShowASimpleThing) {
  const Object object = object_of(box_at({1, 1, 0.2}, {0.4, 0.4, 0.4}));
  for (const auto policy : {ShapePolicy::kBest, ShapePolicy::kHull, ShapePolicy::kVoxels}) {
    EXPECT_NEAR(area_m2(footprint(object, policy).value()), 0.16, 0.02);
  }
}

TEST(Object, MergedObjectsAddUpAndTheOlderIdStays) {
  // [hypermap] 3.4.5: existences add; capped.
  Object a = object_of(box_at({0, 0, 0.2}, {0.4, 0.4, 0.4}));
  Object b = object_of(box_at({0.3, 0, 0.2}, {0.4, 0.4, 0.4}));
  a.id = ObjectId{7};
  b.id = ObjectId{4};
  const Object both = merged(a, b, LogOdds(20.0));
  EXPECT_EQ(both.id, ObjectId{4});
  EXPECT_DOUBLE_EQ(both.existence.value(), 2.0);
  EXPECT_EQ(both.num_observations, 2U);
  EXPECT_EQ(both.shapes.state().num_seen, 2U);
  EXPECT_NEAR(both.box.extent().x(), 0.7, 0.04);
  EXPECT_DOUBLE_EQ(merged(a, b, LogOdds(1.5)).existence.value(), 1.5);
}

TEST(Object, TwoObservationsDoNotOutweighSixtyWhenMerged) {
  const Box box = box_at({0, 0, 0.2}, {0.4, 0.4, 0.4});
  Object often = object_of(box, kObservedClass);
  for (int i = 0; i < 59; ++i)
    update_object(often, observed(surface_of(box), scores(kObservedClass, 0.9)), {});
  Object seldom = object_of(box, ClassId{5});
  update_object(seldom, observed(surface_of(box), scores(ClassId{5}, 0.99)), {});
  EXPECT_EQ(best_class(merged(seldom, often, LogOdds(20.0)))->id, kObservedClass);
}

}  // namespace
}  // namespace hypermap
