// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

const std::vector<std::string> kNames{"ground", "car", "person"};
constexpr std::uint32_t kGround = 0;
constexpr std::uint32_t kCar = 1;
constexpr std::uint32_t kPerson = 2;

/// A street: ground without instances, a car (instance 5) ten metres ahead and a person (instance
/// 6).
LabelledCloud street() {
  LabelledCloud cloud;
  cloud.sensor = {{0.0, 0.0, 1.8}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    cloud.class_vectors.push_back(
        spread_score(ClassId{i}, Probability(0.8), std::vector<ClassId>{{0}, {1}, {2}}));
  }
  const auto add =
      [&](double x, double y, double z, std::uint32_t class_id, std::uint32_t instance) {
        cloud.points_in_map.emplace_back(
            static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        cloud.class_vector_of_point.push_back(class_id);
        cloud.instance_of_point.push_back(instance);
      };
  for (int x = 2; x < 40; ++x) {
    for (int y = -5; y <= 5; ++y) add(x, y, 0.02, kGround, LabelledCloud::kNoInstance);
  }
  for (int y = 0; y < 40; ++y) {
    for (int z = 0; z < 30; ++z) add(10.0, -1.0 + 0.05 * y, 0.2 + 0.05 * z, kCar, 5);
  }
  for (int y = 0; y < 10; ++y) {
    for (int z = 0; z < 34; ++z) add(6.0, 3.0 + 0.05 * y, 0.1 + 0.05 * z, kPerson, 6);
  }
  return cloud;
}

SemanticMapper mapper_without_people() {
  SemanticMapperOptions options;
  options.objects.transient_class_names = {"Person"};
  return SemanticMapper::create(options, ClassRegistry::from_names(kNames).value()).value();
}

TEST(CloudIntegration, InstancesBecomeObjectsAndOtherPointsLabelVoxels) {
  SemanticMapper mapper = mapper_without_people();
  for (std::uint64_t i = 0; i < 3; ++i) {
    LabelledCloud cloud = street();
    cloud.index = i;
    const FrameReport report = mapper.integrate_cloud(cloud).value();
    EXPECT_EQ(report.num_detections, 2U);
    EXPECT_EQ(report.num_transient, 1U);
    EXPECT_EQ(report.num_segments, 1U);
    EXPECT_EQ(report.num_created, i == 0 ? 1U : 0U);
    EXPECT_EQ(report.num_matched, i == 0 ? 0U : 1U);
    EXPECT_FALSE(report.visibility_evaluated);
    EXPECT_GT(report.integration.working_bytes, 0U);
    EXPECT_EQ(report.integration.num_transient, 340U);
    EXPECT_EQ(report.integration.num_not_finite, 0U);
  }
  ASSERT_EQ(mapper.objects().size(), 1U);
  const Object& car = *mapper.objects().objects().begin();
  EXPECT_EQ(best_class(car)->id, ClassId{kCar});
  EXPECT_EQ(car.num_observations, 3U);
  const auto on_car = mapper.octree().at(PointInMap{{10.0, 0.0, 1.0}});
  ASSERT_TRUE(on_car && on_car->occupied);
  EXPECT_EQ(on_car->object, car.id);
  const auto ground = mapper.octree().at(PointInMap{{30.0, 2.0, 0.02}});
  ASSERT_TRUE(ground && ground->occupied);
  EXPECT_EQ(ground->best_class, ClassId{kGround});
  EXPECT_EQ(ground->object, kNoObject);
  EXPECT_FALSE(mapper.octree().at(PointInMap{{6.0, 3.2, 1.0}})) << "a person is no measurement";
}

TEST(CloudIntegration, OnlyWantedClassesReachTheMap) {
  SemanticMapperOptions options;
  options.wanted_class_names = {"person"};
  auto mapper = SemanticMapper::create(options, ClassRegistry::from_names(kNames).value()).value();
  ASSERT_TRUE(mapper.integrate_cloud(street()));
  ASSERT_EQ(mapper.objects().size(), 1U);
  EXPECT_EQ(best_class(*mapper.objects().objects().begin())->id, ClassId{kPerson});
  EXPECT_FALSE(mapper.octree().at(PointInMap{{30.0, 2.0, 0.02}})->best_class);
}

TEST(CloudIntegration, NamesThatNobodyKnowsAreAnError) {
  SemanticMapperOptions options;
  options.objects.transient_class_names = {"ghost"};
  const auto mapper = SemanticMapper::create(options, ClassRegistry::from_names(kNames).value());
  ASSERT_FALSE(mapper);
  EXPECT_EQ(mapper.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(mapper.error().field, "objects.transient_class_names");
  options.objects.transient_class_names = {};
  options.wanted_class_names = {"ghost"};
  EXPECT_EQ(SemanticMapper::create(options).error().field, "wanted_class_names");
}

TEST(CloudIntegration, AScanThatIsRefusedChangesNothing) {
  SemanticMapperOptions options;
  options.cloud.max_memory_mb = 1;
  auto mapper = SemanticMapper::create(options).value();
  const auto refused = mapper.integrate_cloud(street());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_TRUE(mapper.octree().empty());
  EXPECT_TRUE(mapper.objects().empty());
  LabelledCloud unsound = street();
  unsound.instance_of_point.pop_back();
  EXPECT_EQ(mapper.integrate_cloud(unsound).error().field, "instance_of_point");
}

TEST(CloudIntegration, AScanFromOutsideTheVolumeIsRefusedByItsSensor) {
  auto mapper = SemanticMapper::create({}).value();
  LabelledCloud outside = street();
  outside.sensor.xyz.x() = 1e6;
  const auto refused = mapper.integrate_cloud(outside);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "sensor");
}

}  // namespace
}  // namespace hypermap
