// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/turned_box.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kOverlapTolerance = 1e-6;  // What the overlay of polygons rounds.

/// Sides of 4 m by 2 m about the origin, 1 m high, turned about z.
TurnedBox slab(double yaw_rad, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  TurnedBox box;
  box.map_from_box = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d own = box.map_from_box.transpose() * centre;
  box.low = own - Eigen::Vector3d(2.0, 1.0, 0.5);
  box.high = own + Eigen::Vector3d(2.0, 1.0, 0.5);
  return box;
}

TEST(TurnedBox, AroundATurnedRectangleIsThatRectangle) {
  const double turn = 0.3;
  Ring corners;
  const Eigen::Rotation2Dd rotation(turn);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 3), Eigen::Vector2d(0, 3)})
    corners.push_back(rotation * corner);
  const TurnedBox box = turned_box_around(corners, 0.25, 1.0);
  EXPECT_TRUE(box.extent().isApprox(Eigen::Vector3d(3.0, 1.0, 0.75), 1e-12));
  EXPECT_NEAR(
      std::abs(box.map_from_box.col(0).dot(Eigen::Vector3d(-std::sin(turn), std::cos(turn), 0.0))),
      1.0,
      1e-12);
  EXPECT_NEAR(box.low.z(), 0.25, 1e-15);
  EXPECT_NEAR(
      bounding_box(box).volume_m3(),
      0.75 * (std::cos(turn) + 3.0 * std::sin(turn)) * (3.0 * std::cos(turn) + std::sin(turn)),
      1e-12);
}

// [smap] figure B.6.1 in space. Crossed slabs have 2 x 2 x 1 of 8 + 8 - 4 in common: a third.
TEST(TurnedBox, OverlapsByHand) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  EXPECT_NEAR(intersection_over_union(slab(0), slab(0)), 1.0, kOverlapTolerance);
  EXPECT_NEAR(intersection_over_union(slab(0), slab(kQuarter)), 1.0 / 3.0, kOverlapTolerance);
  // Half a metre higher: 4 of 12.
  EXPECT_NEAR(
      intersection_over_union(slab(0.4), slab(0.4, {0, 0, 0.5})), 1.0 / 3.0, kOverlapTolerance);
  EXPECT_EQ(intersection_over_union(slab(0), slab(0, {0, 0, 1.0})), 0.0);
  EXPECT_EQ(intersection_over_union(slab(0), slab(0.7, {9, 0, 0})), 0.0);
  TurnedBox flat = slab(0);
  flat.high.z() = flat.low.z();
  EXPECT_EQ(intersection_over_union(flat, flat), 0.0);
}

// Squares of 2 m, one turned by 45 degrees: a regular octagon of 8 (sqrt 2 - 1) m2 is common.
TEST(TurnedBox, AnOctagonIsCommonToSquaresAcross) {
  TurnedBox square{.low = {-1, -1, 0}, .high = {1, 1, 1}};
  TurnedBox turned = square;
  turned.map_from_box =
      Eigen::AngleAxisd(std::numbers::pi / 4.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const double common = 8.0 * (std::numbers::sqrt2 - 1.0);
  EXPECT_NEAR(intersection_over_union(square, turned), common / (8.0 - common), kOverlapTolerance);
}

TEST(TurnedBox, WithoutATurnItIsTheOverlapOfBoxes) {
  CounterRng random(3, 0);
  const auto corner = [&random] {
    return Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform());
  };
  for (int round = 0; round < 200; ++round) {
    const Eigen::Vector3d low_a = corner();
    const Eigen::Vector3d low_b = corner();
    const Box a{low_a, low_a + corner()};
    const Box b{low_b, low_b + corner()};
    const double overlap = intersection_over_union(turned_box(a), turned_box(b));
    EXPECT_NEAR(overlap, intersection_over_union(a, b), kOverlapTolerance);
    EXPECT_NEAR(overlap, intersection_over_union(turned_box(b), turned_box(a)), kOverlapTolerance);
  }
}

TEST(TurnedBox, TurnedTogetherTheOverlapStays) {
  CounterRng random(5, 0);
  for (int round = 0; round < 100; ++round) {
    const double a_rad = 6.0 * random.uniform();
    const double b_rad = 6.0 * random.uniform();
    const double turn_rad = 6.0 * random.uniform();
    const Eigen::Vector3d offset(random.uniform(), random.uniform(), 0.3 * random.uniform());
    const Eigen::Vector3d turned =
        Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * offset;
    EXPECT_NEAR(intersection_over_union(slab(a_rad), slab(b_rad, offset)),
                intersection_over_union(slab(a_rad + turn_rad), slab(b_rad + turn_rad, turned)),
                kOverlapTolerance);
  }
}

}  // namespace
}  // namespace hypermap
