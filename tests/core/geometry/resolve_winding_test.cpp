// SPDX-License-Identifier: BSD-3-Clause
// Rings that are wound more than once or go back on themselves, and what they stand for.
#include "hypermap/core/geometry/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

Ring square_ring(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST(ResolveWinding, ASimpleRingIsItself) {
  const auto parts = resolve_winding(square_ring(0, 0, 1)).value().parts;
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0], make_polygon(square_ring(0, 0, 1)).value());
}

TEST(ResolveWinding, ARingWoundTwiceIsItsAreaOnce) {
  Ring twice = square_ring(0, 0, 2);
  const Ring again = square_ring(0, 0, 2);
  twice.insert(twice.end(), again.begin(), again.end());
  const auto parts = resolve_winding(twice).value().parts;
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(area_m2(parts[0]), 4.0, 1e-9);
}

TEST(ResolveWinding, OverlappingLoopsFillTheirUnion) {
  // A pentagram winds twice about its middle; its non-zero fill is the whole star. With radius 1
  // the area of the star is 10 tan(pi/10) / (3 - tan(pi/10)^2) = 1.12257.
  Ring star;
  for (int i = 0; i < 5; ++i) {
    const double angle = std::numbers::pi / 2 + 4.0 * std::numbers::pi * i / 5.0;
    star.emplace_back(std::cos(angle), std::sin(angle));
  }
  const auto parts = resolve_winding(star).value().parts;
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].outer.size(), 10U);
  EXPECT_NEAR(area_m2(parts[0]), 1.12257, 1e-5);
}

TEST(ResolveWinding, LoopsThatTouchInAPointAreTwoParts) {
  const auto fill =
      resolve_winding({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}});
  ASSERT_TRUE(fill.has_value()) << fill.error().what;
  const auto& parts = fill->parts;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(area_m2(parts[0]), 1.0, 1e-9);
  EXPECT_NEAR(area_m2(parts[1]), 1.0, 1e-9);
  EXPECT_LT(centroid(parts[0]).y(), centroid(parts[1]).y());
}

TEST(ResolveWinding, ABandAroundNothingKeepsItsHole) {
  // A way around a square courtyard that overlaps its own start: 16 - 4 of area and a hole.
  const Ring band{
      {0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0.5}, {1, 0.5}, {1, 3}, {3, 3}, {3, 1}, {0, 1}};
  const auto fill = resolve_winding(band);
  ASSERT_TRUE(fill.has_value()) << fill.error().what;
  const auto& parts = fill->parts;
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].holes.size(), 1U);
  EXPECT_FALSE(contains(parts[0], {2, 2}));
}

TEST(ResolveWinding, BowTiesAndLinesAreRefused) {
  EXPECT_THAT(resolve_winding({{0, 0}, {2, 2}, {2, 0}, {0, 2}}).error().what, HasSubstr("bow-tie"));
  // There and back along one line: nothing is left but two points.
  EXPECT_THAT(resolve_winding({{0, 0}, {1, 0}, {3, 0}, {2, 0}}).error().what,
              HasSubstr("distinct points"));
}

TEST(ResolveWinding, SpikesEncloseNothingAndAreDropped) {
  const auto fill = resolve_winding({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 3}, {1, 2}, {0, 2}});
  ASSERT_TRUE(fill.has_value()) << fill.error().what;
  EXPECT_TRUE(fill->had_spikes);
  ASSERT_EQ(fill->parts.size(), 1U);
  EXPECT_EQ(area_m2(fill->parts[0]), 4.0);
  // A line of two pieces there and back, and one about the first point.
  const Ring bent{{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 3}, {2, 4}, {1, 3}, {1, 2}, {0, 2}};
  EXPECT_EQ(area_m2(resolve_winding(bent).value().parts.at(0)), 4.0);
  const Ring about_the_start{{-1, 0}, {0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}};
  EXPECT_EQ(area_m2(resolve_winding(about_the_start).value().parts.at(0)), 4.0);
}

TEST(ResolveWinding, ARingWoundTwiceMayHaveSpikesToo) {
  // A square of side 2 wound twice, with a spike from its corner (2, 2) to (5, 2): area 4.
  const Ring ring{
      {0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 2}, {5, 2}, {2, 2}, {0, 2}, {0, 0}};
  const auto fill = resolve_winding(ring);
  ASSERT_TRUE(fill.has_value()) << fill.error().what;
  EXPECT_TRUE(fill->had_spikes);
  ASSERT_EQ(fill->parts.size(), 1U);
  EXPECT_NEAR(area_m2(fill->parts[0]), 4.0, 1e-9);
}

TEST(ResolveWinding, ALineBetweenTwoLoopsIsDropped) {
  // Two unit squares, joined by a line that is passed once each way, not in a row.
  const Ring ring{{0, 0}, {1, 0}, {1, 1}, {3, 1}, {4, 1}, {4, 2}, {3, 2}, {3, 1}, {1, 1}, {0, 1}};
  const auto fill = resolve_winding(ring);
  ASSERT_TRUE(fill.has_value()) << fill.error().what;
  EXPECT_TRUE(fill->had_spikes);
  ASSERT_EQ(fill->parts.size(), 2U);
  EXPECT_NEAR(area_m2(fill->parts[0]) + area_m2(fill->parts[1]), 2.0, 1e-9);
}

TEST(WithoutSpikes, KeepsTheWindingNumbersOfRandomRings) {
  // Spikes put into a simple ring at random places leave the ring as it was.
  std::mt19937 random(5);
  const Ring simple{{0, 0}, {4, 0}, {5, 3}, {2, 5}, {-1, 3}};
  for (int run = 0; run < 200; ++run) {
    Ring ring;
    for (const Eigen::Vector2d& corner : simple) {
      ring.push_back(corner);
      for (auto k = random() % 3; k > 0; --k) {
        const auto far = static_cast<double>(random() % 7);
        ring.push_back(corner + Eigen::Vector2d(far, 1.0));
        ring.push_back(corner);
      }
    }
    EXPECT_EQ(without_spikes(ring).value().ring, simple);
  }
}

TEST(ResolveWinding, RandomScribblesAreRefusedInBoundedTime) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (const std::size_t n : {3000U, 4096U, 50'000U}) {
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) ring.emplace_back(place(random), place(random));
    EXPECT_FALSE(resolve_winding(ring).has_value());
  }
}

}  // namespace
}  // namespace hypermap
