// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/cloud_observations.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

constexpr std::uint32_t kNone = LabelledCloud::kNoClassVector;

TEST(CloudObservations, AnInstanceHasTheMeanOfItsPointsClassesAndTheirBox) {
  LabelledCloud cloud;
  cloud.index = 3;
  cloud.stamp = {50};
  cloud.sensor = {{0.0, 0.0, 1.0}};
  cloud.points_in_map = {{4, 0, 1}, {4, 1, 1}, {4, 0, 2}, {4, 1, 3}, {9, 9, 9}};
  cloud.class_vectors = {{{ClassId{0}, Probability(1.0)}},
                         {{ClassId{0}, Probability(0.25)}, {ClassId{2}, Probability(0.75)}}};
  cloud.class_vector_of_point = {0, 1, 1, kNone, 0};
  cloud.instance_of_point = {8, 8, 8, 8, 0};
  const CloudObservations seen = observe_cloud(cloud);
  ASSERT_EQ(seen.instances.size(), 1U);
  const Observation& instance = seen.instances[0];
  // (1 + 0.25 + 0.25) / 3 and (0.75 + 0.75) / 3
  ASSERT_EQ(instance.class_scores.size(), 2U);
  EXPECT_DOUBLE_EQ(instance.class_scores[0].probability.value(), 0.5);
  EXPECT_DOUBLE_EQ(instance.class_scores[1].probability.value(), 0.5);
  EXPECT_EQ(instance.segment.pixel_indices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(instance.segment.box, (Box{{4, 0, 1}, {4, 1, 3}}));
  EXPECT_DOUBLE_EQ(instance.distance_m, std::sqrt(16.0 + 0.25 + 1.0));
  EXPECT_EQ(instance.frame_index, 3U);
  EXPECT_EQ(instance.stamp, Stamp{50});
  ASSERT_EQ(seen.classes.size(), 1U);
  EXPECT_EQ(seen.classes[0].class_vector, 0U);
  EXPECT_EQ(seen.classes[0].point_indices, std::vector<std::uint32_t>{4});
}

TEST(CloudObservations, PointsOutOfRangeShowNothing) {
  LabelledCloud cloud;
  cloud.points_in_map = {
      {50, 0, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}, {1e30F, 0, 0}};
  cloud.class_vectors = {{{ClassId{0}, Probability(1.0)}}};
  cloud.class_vector_of_point = {0, 0, 0};
  cloud.instance_of_point = {1, 2, 3};
  EXPECT_EQ(observe_cloud(cloud, {.max_range_m = 50.0}).instances.size(), 1U);
  EXPECT_EQ(observe_cloud(cloud, {.max_range_m = 49.0}).instances.size(), 0U);
}

TEST(CloudObservations, InstancesAreThinnedAndInTheOrderOfTheirNumbers) {
  LabelledCloud cloud;
  cloud.points_in_map = {{1, 0, 0}, {2, 0, 0}, {2.001F, 0, 0}};
  cloud.class_vectors = {{{ClassId{0}, Probability(1.0)}}};
  cloud.class_vector_of_point = {0, 0, 0};
  cloud.instance_of_point = {7, 2, 2};
  const CloudObservations seen = observe_cloud(cloud, {.leaf_size_m = 0.1});
  ASSERT_EQ(seen.instances.size(), 2U);
  EXPECT_EQ(seen.instances[0].segment.points_in_map.size(), 1U);
  EXPECT_EQ(seen.instances[0].segment.pixel_indices.size(), 2U);
  EXPECT_EQ(seen.instances[1].segment.box.min_in_map.x(), 1.0);
}

}  // namespace
}  // namespace hypermap
