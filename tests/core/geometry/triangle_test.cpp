// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/triangle.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hypermap {
namespace {

using Eigen::Vector3d;

const Triangle kRightAngled{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 3, 0)};

TEST(Triangle, DistancesByHand) {
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 2}, kRightAngled), 4.0);    // over its inside
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, -2}, kRightAngled), 4.0);   // both sides are one
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 0}, kRightAngled), 0.0);    // in it
  EXPECT_DOUBLE_EQ(squared_distance({2, -3, 4}, kRightAngled), 25.0);  // nearest to an edge
  EXPECT_DOUBLE_EQ(squared_distance({-1, -2, 2}, kRightAngled), 9.0);  // nearest to a corner
  // The longest edge is 3x + 4y = 12; (4, 3) is |12 + 12 - 12| / 5 = 2.4 from it.
  EXPECT_NEAR(squared_distance({4, 3, 0}, kRightAngled), 5.76, 1e-12);
}

TEST(Triangle, WithoutAnAreaItIsASegmentOrAPoint) {
  const Triangle segment{Vector3d(0, 0, 0), Vector3d(2, 0, 0), Vector3d(1, 0, 0)};
  EXPECT_DOUBLE_EQ(squared_distance({1, 3, 0}, segment), 9.0);
  EXPECT_DOUBLE_EQ(squared_distance({4, 0, 0}, segment), 4.0);
  const Triangle point{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1)};
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 4}, point), 9.0);
}

TEST(Triangle, TheNearestPointIsNearerThanAnyOfManySamples) {
  constexpr int kSteps = 60;
  for (std::uint64_t i = 0; i < 200; ++i) {
    CounterRng random(1, 0, i);
    const auto point = [&random] {
      return Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    const Triangle triangle{point(), point(), point()};
    const Vector3d from = point();
    double least = std::numeric_limits<double>::infinity();
    for (int s = 0; s <= kSteps; ++s) {
      for (int t = 0; t <= kSteps - s; ++t) {
        const Vector3d sample = triangle[0] + (triangle[1] - triangle[0]) * s / kSteps +
                                (triangle[2] - triangle[0]) * t / kSteps;
        least = std::min(least, (from - sample).norm());
      }
    }
    const double distance = std::sqrt(squared_distance(from, triangle));
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 4.0 / kSteps);  // samples lie that close to each other
  }
}

}  // namespace
}  // namespace hypermap
