// SPDX-License-Identifier: BSD-3-Clause
// The topological map of the whole mapper: it grows with the frames.
#include "hypermap/core/places/object_vertices.hpp"
#include "hypermap/core/places/topological_routes.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace hypermap {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

const std::vector<RgbdFrame>& frames() {
  static const std::vector<RgbdFrame> kFrames = test::detected_room_frames(12, 160);
  return kFrames;
}

std::vector<Eigen::Vector3d> centres_of(const ObjectMap& objects) {
  std::vector<Eigen::Vector3d> centres;
  for (const Object& object : objects.objects()) centres.push_back(object.centroid_in_map);
  return centres;
}

SemanticMapper mapper_of(const std::vector<RgbdFrame>& frames,
                         const SemanticMapperOptions& options = {}) {
  SemanticMapper mapper = SemanticMapper::create(options).value();
  for (const RgbdFrame& frame : frames) EXPECT_TRUE(mapper.integrate(frame));
  return mapper;
}

TEST(TopologicalGrowth, TheRulesHoldForTheSensorAndAllObjects) {
  const SemanticMapper mapper = mapper_of(frames());
  const TopologicalMap& map = mapper.topological_map();
  ASSERT_FALSE(mapper.objects().empty());
  EXPECT_THAT(broken_rules(map, centres_of(mapper.objects())), IsEmpty());
  ASSERT_TRUE(map.walk());
  EXPECT_EQ(map.walk()->position_in_map, frames().back().map_from_camera.origin().xyz);
  for (const Object& object : mapper.objects().objects()) {
    EXPECT_LT(
        (map.vertices()[vertex_of(map, object)->value].position_in_map - object.centroid_in_map)
            .norm(),
        1.0);
  }
}

TEST(TopologicalGrowth, ItDependsOnNoNumberOfThreadsAndFollowsItsOptions) {
  const SemanticMapper one = mapper_of(frames());
  const SemanticMapper four = mapper_of(frames(), {.num_threads = 4});
  EXPECT_EQ(one.topological_map(), four.topological_map());
  const SemanticMapper fine = mapper_of(frames(), {.places = {.vertex_distance_m = 0.3}});
  EXPECT_GT(fine.topological_map().vertices().size(), one.topological_map().vertices().size());
  EXPECT_EQ(fine.objects(), one.objects());
}

TEST(TopologicalGrowth, ARunThatGoesOnMakesTheMapOfTheWholeRun) {
  const SemanticMapper whole = mapper_of(frames());
  const std::size_t half = frames().size() / 2;
  const std::vector<RgbdFrame> first(frames().begin(),
                                     frames().begin() + static_cast<std::ptrdiff_t>(half));
  const SemanticMapper before = mapper_of(first);
  SemanticMapper after =
      SemanticMapper::resume({}, before.octree(), before.objects(), {}, before.topological_map())
          .value();
  for (std::size_t i = half; i < frames().size(); ++i) ASSERT_TRUE(after.integrate(frames()[i]));
  EXPECT_EQ(after.topological_map(), whole.topological_map());
}

TEST(TopologicalGrowth, AMapThatWasMadeWithoutIsMadeTowardAllItsObjects) {
  const SemanticMapper before = mapper_of(frames());
  SemanticMapper after = SemanticMapper::resume({}, before.octree(), before.objects()).value();
  EXPECT_THAT(after.topological_map().vertices(), IsEmpty());
  ASSERT_TRUE(after.integrate(frames().front()));
  EXPECT_THAT(broken_rules(after.topological_map(), centres_of(after.objects())), IsEmpty());
}

TEST(TopologicalGrowth, AMapOfOtherOptionsIsNotGoneOnFrom) {
  const SemanticMapper before = mapper_of({frames().front()});
  const auto other = SemanticMapper::resume({.places = {.edge_factor = 0.5}},
                                            before.octree(),
                                            before.objects(),
                                            {},
                                            before.topological_map());
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().field, "places");
}

/// Knows of one class that it is twice as probable, and how often it was asked.
class Insistent final : public ClassPriorSource {
 public:
  explicit Insistent(ClassId id) : id_(id) {}
  [[nodiscard]] ClassPrior prior_of(const Observation&,
                                    const ObjectMap&,
                                    const TopologicalMap&,
                                    const ClassRegistry&) const override {
    return ClassPrior::create({{id_, LogOdds(std::log(2.0))}}).value();
  }

 private:
  ClassId id_;
};

TEST(TopologicalGrowth, OutsideKnowledgeReachesTheObjectsThatAreObserved) {
  SemanticMapper mapper = SemanticMapper::create({}).value();
  const ClassId id{3};
  mapper.set_prior_source(std::make_shared<const Insistent>(id));
  for (const RgbdFrame& frame : frames()) ASSERT_TRUE(mapper.integrate(frame));
  ASSERT_FALSE(mapper.objects().empty());
  for (const Object& object : mapper.objects().objects()) {
    EXPECT_NEAR(object.prior.factor(id), 2.0, 1e-12);
  }
  const SemanticMapper without = mapper_of(frames());
  for (const Object& object : without.objects().objects()) EXPECT_TRUE(object.prior.empty());
}

/// Along one side of a wall that ends at x = 3.2 m and back along the other, 0.6 m apart.
TEST(TopologicalGrowth, PlacesOnBothSidesOfAWallAreNotJoinedThroughIt) {
  test::BoxScene scene(test::half_kinect_camera());
  scene.add(1, {-1, -3, -0.1}, {5, 3, 0}).add(2, {-1, -0.05, 0}, {3.2, 0.05, 2.5});
  SemanticMapper mapper = SemanticMapper::create({}).value();
  std::vector<Eigen::Vector3d> way;
  for (int i = 0; i <= 18; ++i) way.emplace_back(0.2 * i, -0.3, 1.3);
  for (int i = 0; i <= 3; ++i) way.emplace_back(3.6, -0.3 + 0.2 * i, 1.3);
  for (int i = 18; i >= 4; --i) way.emplace_back(0.2 * i, 0.3, 1.3);
  for (std::size_t i = 0; i < way.size(); ++i) {
    // It looks ahead and toward the wall.
    const double yaw_rad = way[i].y() < 0.0 ? 0.35 : -0.35;
    RgbdFrame frame = scene.view(test::camera_at(way[i], yaw_rad, -0.2), 1).frame;
    frame.index = i;
    ASSERT_TRUE(mapper.integrate(frame));
  }
  const TopologicalMap& map = mapper.topological_map();
  EXPECT_THAT(connected_pieces(map), testing::Each(0U));
  for (const auto& [from, to] : map.edges()) {
    const Eigen::Vector3d& a = map.vertices()[from.value].position_in_map;
    const Eigen::Vector3d& b = map.vertices()[to.value].position_in_map;
    if (a.y() * b.y() >= 0.0) continue;
    EXPECT_GT(0.5 * (a.x() + b.x()), 3.1) << from.value << " and " << to.value;
  }
}

}  // namespace
}  // namespace hypermap
