// SPDX-License-Identifier: BSD-3-Clause
// The policies of the two sources.
#include "core/objects/association_cases.hpp"
#include "hypermap/core/objects/association.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kChairBox;
using testing_support::kChairClass;
using testing_support::kCupClass;
using testing_support::seen;
using testing_support::with;

TEST(OverlapPolicy, AJaccardIndexOfATwentiethIsTooLittle) {
  // [hypermap] 3.4.5, 0.2: squares of 0.5 shifted by s share (0.5 - s) 0.5 of 0.5 - that; by 0.3:
  // 0.1 / 0.4 = 0.25 matches, by 0.4: 0.05 / 0.45 = 0.11 does not.
  for (const auto& [shift, num_objects] : {std::pair{0.3, 1U}, std::pair{0.4, 2U}}) {
    ObjectMap map;
    const auto options = with(AssociationPolicy::kOverlap);
    (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options);
    (void)associate(
        map, std::array{seen(box_at({shift, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass)}, options);
    EXPECT_EQ(map.size(), num_objects) << shift;
  }
}

TEST(OverlapPolicy, SeveralMatchesAreCombined) {
  // [hypermap] 3.4.5: existences add: 1 + 1, then + 1 for the new evidence.
  ObjectMap map;
  const auto options = with(AssociationPolicy::kOverlap);
  (void)associate(map,
                  std::array{seen(box_at({-0.2, 0, 0.2}, {0.4, 0.4, 0.4}), kChairClass),
                             seen(box_at({0.2, 0, 0.2}, {0.36, 0.4, 0.4}), kChairClass)},
                  options);
  ASSERT_EQ(map.size(), 2U);
  const auto report =
      associate(map, std::array{seen(box_at({0, 0, 0.2}, {0.8, 0.4, 0.4}), kChairClass)}, options);
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(report.merged, (std::vector{ObjectMerge{ObjectId{2}, ObjectId{1}}}));
  EXPECT_DOUBLE_EQ(map.at(ObjectId{1}).existence.value(), 3.0);
}

// [hypermap] 3.4.5, the other way: each object has the evidence, 1 + 1.
TEST(OverlapPolicy, SeveralMatchesAreKeptApartWhereThatIsAskedFor) {
  ObjectMap map;
  AssociationOptions options = with(AssociationPolicy::kOverlap);
  options.several_matches = SeveralMatches::kKeepApart;
  (void)associate(map,
                  std::array{seen(box_at({-0.2, 0, 0.2}, {0.4, 0.4, 0.4}), kChairClass),
                             seen(box_at({0.2, 0, 0.2}, {0.36, 0.4, 0.4}), kChairClass)},
                  options);
  ASSERT_EQ(map.size(), 2U);
  const auto report =
      associate(map, std::array{seen(box_at({0, 0, 0.2}, {0.8, 0.4, 0.4}), kChairClass)}, options);
  ASSERT_EQ(map.size(), 2U);
  EXPECT_TRUE(report.merged.empty());
  EXPECT_EQ(report.object_of_observation, (std::vector{ObjectId{1}}));
  EXPECT_EQ(report.matched, (std::vector{ObjectId{1}, ObjectId{2}}));
  for (const std::uint32_t id : {1U, 2U}) {
    EXPECT_DOUBLE_EQ(map.at(ObjectId{id}).existence.value(), 2.0);
  }
}

TEST(OverlapPolicy, AnotherClassIsAnotherObject) {
  ObjectMap map;
  const auto options = with(AssociationPolicy::kOverlap);
  (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options);
  (void)associate(map, std::array{seen(kChairBox, kCupClass)}, options);
  EXPECT_EQ(map.size(), 2U);
}

TEST(RadiusPolicy, TheSquareReachesHalfAMetre) {
  // [hypermap] 5.2.4: boxes that meet the square of half side 0.5 m around the centroid.
  for (const auto& [shift, num_objects] : {std::pair{0.7, 1U}, std::pair{0.8, 2U}}) {
    ObjectMap map;
    const auto options = with(AssociationPolicy::kRadius);
    (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options);
    (void)associate(
        map, std::array{seen(box_at({shift, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass)}, options);
    EXPECT_EQ(map.size(), num_objects) << shift;
  }
}

TEST(SmapPolicy, CandidatesAreNearerThanTheProductOfErrorAndFactor) {
  // [smap] 3.5.4, C.2.3, table D.2: o_e o_t = 0.2 * 0.5 = 0.1 m.
  for (const auto& [shift, num_objects] : {std::pair{0.09, 1U}, std::pair{0.11, 2U}}) {
    ObjectMap map;
    const auto options = with(AssociationPolicy::kSmap);
    (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options);
    (void)associate(
        map, std::array{seen(box_at({shift, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass)}, options);
    EXPECT_EQ(map.size(), num_objects) << shift;
  }
}

TEST(SmapPolicy, ConeAndNeighbourhoodLimitTheCandidates) {
  // [smap] figure 3.22, steps 1 and C.2.2.
  const auto options = with(AssociationPolicy::kSmap);
  const ActiveCone ahead{.apex = PointInMap{{0, -2, 0.45}},
                         .axis_in_map = Eigen::Vector3d::UnitY(),
                         .half_angle_rad = 0.5,
                         .min_range_m = 0.2,
                         .max_range_m = 5.0};
  ActiveCone behind = ahead;
  behind.axis_in_map = -ahead.axis_in_map;
  for (const auto& [scope, num_objects] :
       {std::pair{ObjectScope{.cone = ahead}, 1U},
        std::pair{ObjectScope{.cone = behind}, 2U},
        std::pair{ObjectScope{.is_near = [](const auto&) { return false; }}, 2U},
        std::pair{ObjectScope{.is_near = [](const auto&) { return true; }}, 1U}}) {
    ObjectMap map;
    (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options, scope);
    (void)associate(map, std::array{seen(kChairBox, kChairClass)}, options, scope);
    EXPECT_EQ(map.size(), num_objects);
  }
}

}  // namespace
}  // namespace hypermap
