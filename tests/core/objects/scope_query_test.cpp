// SPDX-License-Identifier: BSD-3-Clause
#include "objects/scope_query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

ActiveCone cone_along(const Eigen::Vector3d& axis, double half_angle_rad) {
  return {.apex = {{1, 2, 3}},
          .axis_in_map = axis,
          .half_angle_rad = half_angle_rad,
          .min_range_m = 0.5,
          .max_range_m = 2.0};
}

// 2 m along x with an eighth of a turn to each side: a disc of 2 m across y and z at x = 3.
TEST(ConeBounds, ReachFromTheApexToTheDiscAtItsEnd) {
  const Box box = bounds(cone_along({1, 0, 0}, 0.25 * std::numbers::pi));
  EXPECT_TRUE(box.min_in_map.isApprox(Eigen::Vector3d(1, 0, 1), 1e-5));
  EXPECT_TRUE(box.max_in_map.isApprox(Eigen::Vector3d(3, 4, 5), 1e-5));
}

// Axis (0.6, 0.8, 0), tangent 0.5: the disc of 1 m around (2.2, 3.6, 3) reaches 0.8 m along x, 0.6
// m along y and 1 m along z.
TEST(ConeBounds, ReachAsFarAsATurnedDisc) {
  const Box box = bounds(cone_along({0.6, 0.8, 0.0}, std::atan(0.5)));
  EXPECT_TRUE(box.min_in_map.isApprox(Eigen::Vector3d(1, 2, 2), 1e-5));
  EXPECT_TRUE(box.max_in_map.isApprox(Eigen::Vector3d(3.0, 4.2, 4.0), 1e-5));
}

/// Boxes in a room of 8 m, each with its centroid somewhere within.
ObjectMap crowd(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  ObjectMap objects;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d low(place(random), place(random), place(random));
    const Eigen::Vector3d extent(part(random), part(random), part(random));
    Object object;
    object.box = {low, low + extent};
    object.centroid_in_map =
        low + Eigen::Vector3d(part(random), part(random), part(random)).cwiseProduct(extent);
    objects.add(std::move(object));
  }
  return objects;
}

std::vector<ObjectId> one_by_one(const ObjectMap& objects, const ObjectScope& scope) {
  std::vector<ObjectId> ids;
  for (const Object& object : objects.objects()) {
    if (scope.contains(object.centroid_in_map)) ids.push_back(object.id);
  }
  return ids;
}

TEST(ObjectsIn, AreThoseThatTheScopeContainsInOrder) {
  std::mt19937 random(3);
  const ObjectMap objects = crowd(random);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  std::uniform_real_distribution<double> angle_rad(0.05, 1.5);
  const auto is_high = [](const Eigen::Vector3d& centroid) { return centroid.z() > 0.0; };
  std::size_t num_found = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(part(random), part(random), part(random)).normalized();
    ObjectScope scope{.cone = cone_along(axis, angle_rad(random))};
    EXPECT_EQ(objects_in(objects, scope), one_by_one(objects, scope));
    scope.is_near = is_high;
    const auto found = objects_in(objects, scope);
    EXPECT_EQ(found, one_by_one(objects, scope));
    num_found += found.size();
  }
  EXPECT_GT(num_found, 500U);
}

TEST(ObjectsIn, WithoutAConeAreAskedOneByOne) {
  std::mt19937 random(3);
  const ObjectMap objects = crowd(random);
  const auto is_high = [](const Eigen::Vector3d& centroid) { return centroid.z() > 0.0; };
  EXPECT_EQ(objects_in(objects, {}).size(), 300U);
  EXPECT_EQ(objects_in(objects, {.is_near = is_high}), one_by_one(objects, {.is_near = is_high}));
}

}  // namespace
}  // namespace hypermap
