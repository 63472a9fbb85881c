// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/instance_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Box box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  return {centre - 0.5 * size, centre + 0.5 * size};
}

const Eigen::Vector3d kChairSize(0.5, 0.5, 0.8);

ComparedInstance chair_at(double x, InstanceStanding standing = InstanceStanding::kCounts) {
  return {.class_names = {"chair"}, .box = box_at({x, 0.0, 0.4}, kChairSize), .standing = standing};
}

ComparedObject object_at(double x,
                         const std::string& class_name = "chair",
                         const Eigen::Vector3d& size = kChairSize) {
  return {.class_name = class_name, .box = box_at({x, 0.0, 0.4}, size)};
}

TEST(InstanceComparison, AInstanceFoundOnceInPlaceAndOfItsSizeIsRight) {
  const InstanceComparison result =
      compare_instances(std::vector{object_at(1.1)}, std::vector{chair_at(1.0)});
  EXPECT_EQ(result.instances[0].object, 0U);
  EXPECT_NEAR(result.instances[0].distance_m, 0.1, 1e-12);
  EXPECT_TRUE(result.instances[0].side_ratios.isApprox(Eigen::Vector3d::Ones()));
  EXPECT_TRUE(result.instances[0].is_right());
  EXPECT_EQ(result.counts.right, 1U);
  EXPECT_THAT(result.false_objects, IsEmpty());
}

TEST(InstanceComparison, PlaceAndSizeHaveTolerancesOfTheirOwn) {
  // Limits of exact binary fractions: a distance of exactly 0.25 m is in place.
  const auto at = [](double x) {
    return compare_instances(std::vector{object_at(x)}, std::vector{chair_at(0.0)}).instances[0];
  };
  EXPECT_TRUE(at(0.25).is_in_place);
  EXPECT_TRUE(at(0.26).object.has_value());
  EXPECT_FALSE(at(0.26).is_in_place);
  EXPECT_TRUE(at(0.5).object.has_value());
  EXPECT_FALSE(at(0.51).object.has_value());
  const auto sized = [](const Eigen::Vector3d& factor) {
    const auto object = object_at(0.0, "chair", kChairSize.cwiseProduct(factor));
    return compare_instances(std::vector{object}, std::vector{chair_at(0.0)}).instances[0];
  };
  EXPECT_TRUE(sized({1.39, 0.61, 1.0}).is_of_right_size);
  EXPECT_FALSE(sized({1.41, 1.0, 1.0}).is_of_right_size);
  EXPECT_FALSE(sized({1.0, 0.59, 1.0}).is_of_right_size);
  EXPECT_NEAR(sized({1.0, 0.59, 1.0}).side_ratios.y(), 0.59, 1e-12);
}

TEST(InstanceComparison, HeightsOfChairsAreHeldTighter) {
  const auto height = [](const std::string& name, double factor) {
    ComparedInstance instance = chair_at(0.0);
    instance.class_names = {name};
    const auto object = object_at(0.0, name, {0.5, 0.5, 0.8 * factor});
    return compare_instances(std::vector{object}, std::vector{instance})
        .instances[0]
        .is_of_right_size;
  };
  EXPECT_TRUE(height("chair", 0.81));
  EXPECT_FALSE(height("chair", 0.79));
  EXPECT_FALSE(height("Chair", 1.21));
  EXPECT_TRUE(height("sofa", 0.79));
}

TEST(InstanceComparison, AFurtherObjectOfTheClassIsADuplicate) {
  const InstanceComparison result = compare_instances(
      std::vector{object_at(0.4), object_at(0.1), object_at(0.6)}, std::vector{chair_at(0.0)});
  EXPECT_EQ(result.instances[0].object, 1U);
  EXPECT_THAT(result.instances[0].duplicates, ElementsAre(0U));
  EXPECT_FALSE(result.instances[0].is_right());
  EXPECT_THAT(result.false_objects, ElementsAre(2U));
  EXPECT_EQ(result.counts.duplicates, 1U);
}

TEST(InstanceComparison, AnObjectInPlaceIsNotTakenByANeighbour) {
  // At the largest number of pairs the object at 0 would go to the thing at 0.45, the false one at
  // -0.45 to the thing at 0.
  const InstanceComparison result = compare_instances(std::vector{object_at(0.0), object_at(-0.45)},
                                                      std::vector{chair_at(0.0), chair_at(0.45)});
  EXPECT_EQ(result.instances[0].object, 0U);
  EXPECT_FALSE(result.instances[1].object.has_value());
  EXPECT_THAT(result.instances[0].duplicates, ElementsAre(1U));
}

TEST(InstanceComparison, TheReachOfALargeInstanceIsHalfItsLongestHorizontalSide) {
  const ComparedInstance table{.class_names = {"diningtable"},
                               .box = box_at({0.0, 0.0, 0.4}, {2.0, 0.9, 0.7})};
  const auto is_found = [&](double x) {
    const auto object = object_at(x, "dining table");
    return compare_instances(std::vector{object}, std::vector{table})
        .instances[0]
        .object.has_value();
  };
  EXPECT_TRUE(is_found(0.99));
  EXPECT_FALSE(is_found(1.01));
  ComparedInstance cup{.class_names = {"cup"}, .box = box_at({0.0, 0.0, 0.4}, {0.1, 0.1, 0.1})};
  const auto object = object_at(0.26, "cup", {0.1, 0.1, 0.1});
  EXPECT_FALSE(
      compare_instances(std::vector{object}, std::vector{cup}).instances[0].object.has_value());
}

TEST(InstanceComparison, AMissedInstanceTellsWhichOtherClassStandsThere) {
  const InstanceComparison result = compare_instances(
      std::vector{object_at(0.1, "bed"), object_at(3.0, "bed")}, std::vector{chair_at(0.0)});
  EXPECT_FALSE(result.instances[0].object.has_value());
  EXPECT_THAT(result.instances[0].others, ElementsAre(0U));
  EXPECT_THAT(result.false_objects, ElementsAre(1U));
  EXPECT_EQ(result.counts.wrong_class, 1U);
  EXPECT_EQ(result.counts.found, 0U);
}

TEST(InstanceComparison, AnotherClassOnAInstanceThatIsFoundIsFalse) {
  const InstanceComparison result = compare_instances(
      std::vector{object_at(0.0), object_at(0.0, "handbag")}, std::vector{chair_at(0.0)});
  EXPECT_TRUE(result.instances[0].is_right());
  EXPECT_THAT(result.false_objects, ElementsAre(1U));
}

TEST(InstanceComparison, AnyListedClassIsRight) {
  ComparedInstance armchair = chair_at(0.0);
  armchair.class_names = {"chair", "sofa"};
  const auto sofa =
      compare_instances(std::vector{object_at(0.0, "couch")}, std::vector{armchair}).instances[0];
  EXPECT_TRUE(sofa.is_right());
}

TEST(InstanceComparison, WhatDoesNotCountIsNeitherMissedNorFalse) {
  const ComparedInstance cabinet{.box = box_at({5.0, 0.0, 0.3}, {0.8, 0.4, 0.6}),
                                 .standing = InstanceStanding::kNoWord};
  const InstanceComparison result =
      compare_instances(std::vector{object_at(0.0), object_at(5.0, "refrigerator"), object_at(2.1)},
                        std::vector{chair_at(0.0, InstanceStanding::kNoDepth),
                                    cabinet,
                                    chair_at(2.0, InstanceStanding::kRarelySeen),
                                    chair_at(9.0, InstanceStanding::kFar)});
  EXPECT_EQ(result.counts.counted, 0U);
  EXPECT_EQ(result.instances[0].object, 0U);
  EXPECT_THAT(result.instances[1].others, ElementsAre(1U));
  EXPECT_EQ(result.instances[2].object, 2U);
  EXPECT_FALSE(result.instances[3].object.has_value());
  EXPECT_THAT(result.false_objects, IsEmpty());
}

TEST(InstanceComparison, AnObjectLiesOnTheNearestOfInstancesThatDoNotCount) {
  const ComparedInstance box{.box = box_at({0.1, 0.0, 0.7}, {0.3, 0.3, 0.1}),
                             .standing = InstanceStanding::kNoWord};
  const ComparedObject phone{.class_name = "cell phone",
                             .box = box_at({0.1, 0.0, 0.72}, {0.3, 0.3, 0.1})};
  const InstanceComparison result = compare_instances(
      std::vector{phone}, std::vector{chair_at(0.0, InstanceStanding::kNoDepth), box});
  EXPECT_THAT(result.instances[0].others, IsEmpty());
  EXPECT_THAT(result.instances[1].others, ElementsAre(0U));
}

TEST(InstanceComparison, WhatCountsIsServedFirst) {
  const InstanceComparison result =
      compare_instances(std::vector{object_at(0.2)},
                        std::vector{chair_at(0.3, InstanceStanding::kNoDepth), chair_at(-0.2)});
  EXPECT_FALSE(result.instances[0].object.has_value());
  EXPECT_EQ(result.instances[1].object, 0U);
}

TEST(InstanceComparison, NoObjectsAndNoInstancesAreNoMatter) {
  EXPECT_EQ(compare_instances({}, {}).counts.counted, 0U);
  EXPECT_EQ(compare_instances({}, std::vector{chair_at(0.0)}).counts.counted, 1U);
  EXPECT_EQ(compare_instances(std::vector{object_at(0.0)}, {}).counts.false_objects, 1U);
}

TEST(InstanceComparison, BadTolerancesAreRefusedByName) {
  const auto refused = validate(InstanceComparisonOptions{.gate_m = 0.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "gate_m");
  EXPECT_FALSE(validate(
      InstanceComparisonOptions{.max_side_share = std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace hypermap
