// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

Ring square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Polygon polygon_of(const Ring& ring) {
  return make_polygon(ring).value();
}

std::string refusal(const Ring& ring, const std::vector<Ring>& holes = {}) {
  const auto polygon = make_polygon(ring, holes);
  return polygon ? "accepted" : polygon.error().what;
}

TEST(Polygon, ClosedClockwiseAndRepeatedPointsAreMended) {
  const Polygon p = polygon_of({{0, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 0}, {0, 0}});
  EXPECT_EQ(p.outer.size(), 4U);
  EXPECT_DOUBLE_EQ(area_m2(p), 1.0);
  EXPECT_EQ(p, polygon_of({{1, 0}, {1, 1}, {0, 1}, {0, 0}}));
}

TEST(Polygon, TheHoleIsNoArea) {
  // 4 * 4 - 1 * 1 = 15; the centroid of the square is (2, 2), of the hole (1.5, 1.5):
  // (16 * 2 - 1 * 1.5) / 15 = 30.5 / 15.
  const Polygon p = make_polygon(square(0, 0, 4), {square(1, 1, 1)}).value();
  EXPECT_DOUBLE_EQ(area_m2(p), 15.0);
  EXPECT_NEAR(centroid(p).x(), 30.5 / 15.0, 1e-12);
  EXPECT_FALSE(contains(p, {1.5, 1.5}));
  EXPECT_TRUE(contains(p, {1.0, 1.5}));
  EXPECT_TRUE(contains(p, {3.0, 3.0}));
}

TEST(Polygon, EdgesAndCornersAreInside) {
  const Polygon p = polygon_of(square(0, 0, 1));
  EXPECT_TRUE(contains(p, {0.0, 0.0}));
  EXPECT_TRUE(contains(p, {0.5, 1.0}));
  EXPECT_FALSE(contains(p, {0.5, std::nextafter(1.0, 2.0)}));
  EXPECT_FALSE(contains(p, {-1.0, 0.0}));
}

TEST(Polygon, PiecesThatOverlapAreUnitedToOne) {
  // Two squares of side 2 that share one of side 1: 4 + 4 - 1 = 7, in the shape of a Z with eight
  // corners.
  const auto united = unite(std::array{polygon_of(square(0, 0, 2)), polygon_of(square(1, 1, 2))});
  ASSERT_TRUE(united.has_value());
  ASSERT_EQ(united->size(), 1U);
  EXPECT_NEAR(area_m2(united->front()), 7.0, 1e-12);
  EXPECT_EQ(united->front().outer.size(), 8U);
  EXPECT_TRUE(make_polygon(united->front().outer).has_value());
}

TEST(Polygon, PiecesThatDoNotMeetStayApart) {
  const auto united = unite(std::array{polygon_of(square(0, 0, 1)), polygon_of(square(5, 0, 2))});
  ASSERT_TRUE(united.has_value());
  ASSERT_EQ(united->size(), 2U);
  EXPECT_NEAR(area_m2(united->front()) + area_m2(united->back()), 5.0, 1e-12);
  EXPECT_TRUE(unite({}).value().empty());
}

TEST(Polygon, WhatAFrameEnclosesIsAHoleOfTheUnion) {
  // Four bars of 4 by 1 around a square of 2 by 2: 16 - 4 = 12.
  const auto bar = [](double x, double y, double width, double height) {
    return polygon_of({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
  };
  const auto united =
      unite(std::array{bar(0, 0, 4, 1), bar(0, 3, 4, 1), bar(0, 0, 1, 4), bar(3, 0, 1, 4)});
  ASSERT_TRUE(united.has_value());
  ASSERT_EQ(united->size(), 1U);
  EXPECT_EQ(united->front().holes.size(), 1U);
  EXPECT_NEAR(area_m2(united->front()), 12.0, 1e-12);
}

TEST(Polygon, CoveredShareByHand) {
  // Of 2 m by 2 m the other covers a column of 0.5 m; of the other's 4 m2 it is a quarter of half.
  const Polygon a = make_polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}}).value();
  const Polygon b = make_polygon({{1.5, 0}, {3.5, 0}, {3.5, 4}, {1.5, 4}}).value();
  EXPECT_NEAR(covered_share(a, b), 0.25, 1e-12);
  EXPECT_NEAR(covered_share(b, a), 0.125, 1e-12);
  EXPECT_NEAR(covered_share(a, a), 1.0, 1e-12);
  EXPECT_EQ(covered_share(a, translated(b, {1, 0})), 0.0);
}

TEST(Polygon, JaccardByHand) {
  // [hypermap] 3.4.1: squares of side 2 shifted by 1 share 2 of 4 + 4 - 2 = 6.
  const Polygon a = polygon_of(square(0, 0, 2));
  EXPECT_NEAR(jaccard(a, polygon_of(square(1, 0, 2))), 2.0 / 6.0, 1e-12);
  EXPECT_NEAR(jaccard(a, a), 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(jaccard(a, polygon_of(square(2, 0, 2))), 0.0);
  EXPECT_DOUBLE_EQ(jaccard(a, polygon_of(square(5, 5, 2))), 0.0);
}

TEST(Polygon, PolygonsThatTouchIntersect) {
  const Polygon a = polygon_of(square(0, 0, 1));
  EXPECT_TRUE(intersects(a, polygon_of(square(1, 1, 1))));
  EXPECT_TRUE(intersects(a, polygon_of(square(0.25, 0.25, 0.5))));
  EXPECT_FALSE(intersects(a, polygon_of(square(1.001, 0, 1))));
}

TEST(Polygon, RefusalsNameTheReason) {
  EXPECT_THAT(refusal({}), HasSubstr("0 distinct points"));
  EXPECT_THAT(refusal({{1, 2}}), HasSubstr("1 distinct points"));
  EXPECT_THAT(refusal({{0, 0}, {1, 0}, {0, 0}, {1, 0}}), HasSubstr("2 distinct points"));
  EXPECT_THAT(refusal({{0, 0}, {1, 0}, {2, 0}}), HasSubstr("spike"));
  EXPECT_THAT(refusal({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 3}, {1, 2}, {0, 2}}),
              HasSubstr("spike at (1, 3)"));
  EXPECT_THAT(refusal({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), HasSubstr("crosses"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal({{0, 0}, {nan, 0}, {1, 1}}), HasSubstr("point 1 is (nan, 0)"));
  EXPECT_THAT(refusal({{0, 0}, {1e308, 0}, {1, 1}}), HasSubstr("1e6 m"));
  EXPECT_THAT(refusal({{0, 0}, {1e9, 0}, {1, 1}}), HasSubstr("1e6 m"));
}

TEST(Polygon, ARingThatTouchesItselfIsRefused) {
  EXPECT_THAT(refusal({{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}), HasSubstr("touches"));
  EXPECT_THAT(refusal({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}), HasSubstr("touches"));
}

TEST(Polygon, HolesMustLieInsideAndApart) {
  const Ring outer = square(0, 0, 10);
  EXPECT_THAT(refusal(outer, {square(20, 20, 1)}), HasSubstr("hole 1 lies outside"));
  EXPECT_THAT(refusal(outer, {square(1, 1, 3), square(2, 2, 1)}), HasSubstr("hole 2 lies inside"));
  EXPECT_THAT(refusal(outer, {square(1, 1, 3), square(2, 2, 3)}), HasSubstr("cross"));
  EXPECT_THAT(refusal(outer, {square(1, 1, 3), square(1, 1, 3)}), HasSubstr("cross"));
  EXPECT_EQ(refusal(outer, {square(1, 1, 3), square(5, 5, 3)}), "accepted");
}

TEST(Polygon, RingsMayTouchInCommonCornersFromTheRightSide) {
  const Ring outer = square(0, 0, 10);
  const Ring at_a_corner{{0, 0}, {3, 1}, {1, 3}};
  EXPECT_DOUBLE_EQ(area_m2(make_polygon(outer, {at_a_corner}).value()), 100.0 - 4.0);
  // In two corners, one of them a notch; two holes in one point.
  const Ring with_notch{{0, 0}, {10, 0}, {10, 10}, {5, 8}, {0, 10}};
  EXPECT_EQ(refusal(with_notch, {{{0, 0}, {5, 8}, {2, 6}}}), "accepted");
  EXPECT_EQ(refusal(outer, {{{5, 5}, {3, 4}, {3, 6}}, {{5, 5}, {7, 4}, {7, 6}}}), "accepted");
  // Elsewhere than in corners; from outside; one hole within the other; along an edge.
  EXPECT_THAT(refusal(outer, {{{5, 0}, {6, 2}, {4, 2}}}), HasSubstr("cross or touch"));
  EXPECT_THAT(refusal(outer, {{{0, 0}, {-3, -1}, {-1, -3}}}), HasSubstr("cross or touch"));
  EXPECT_THAT(refusal(outer, {{{5, 5}, {1, 3}, {1, 7}}, {{5, 5}, {3, 4.5}, {3, 5.5}}}),
              HasSubstr("cross or touch"));
  EXPECT_THAT(refusal(outer, {{{0, 0}, {10, 0}, {5, 5}}}), HasSubstr("cross or touch"));
}

TEST(Polygon, HolesThatTouchLieInsideAndApart) {
  // Corners on a coarse lattice touch often. Whether a point lies in each ring alone decides.
  std::mt19937 random(17);
  const auto random_triangle = [&] {
    Ring ring;
    for (int i = 0; i < 3; ++i)
      ring.emplace_back(static_cast<double>(random() % 5), static_cast<double>(random() % 5));
    return ring;
  };
  const auto touch = [](const Ring& a, const Ring& b) {
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  };
  const Polygon solid =
      polygon_of({{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 3}, {0, 4}, {0, 2}, {1, 1}});
  int num_touching = 0;
  for (int round = 0; round < 60'000; ++round) {
    const auto polygon = make_polygon(solid.outer, {random_triangle(), random_triangle()});
    if (!polygon) continue;
    const Ring& hole = polygon->holes[0];
    const Ring& other = polygon->holes[1];
    num_touching += touch(solid.outer, hole) || touch(hole, other) ? 1 : 0;
    for (double x = 0.1234567; x < 4.0; x += 0.25) {
      for (double y = 0.1765432; y < 4.0; y += 0.25) {
        const bool in_hole = contains(Polygon{hole, {}}, {x, y});
        const bool in_other = contains(Polygon{other, {}}, {x, y});
        const bool in_solid = contains(solid, {x, y});
        ASSERT_FALSE(in_hole && in_other) << "round " << round;
        ASSERT_TRUE(in_solid || !(in_hole || in_other)) << "round " << round;
        ASSERT_EQ(contains(*polygon, {x, y}), in_solid && !in_hole && !in_other)
            << "round " << round;
      }
    }
  }
  EXPECT_GT(num_touching, 50);
}

TEST(Polygon, RoundingDoesNotInventCrossings) {
  // A sliver whose sides are one unit in the last place apart.
  const double up = std::nextafter(0.1, 1.0);
  EXPECT_EQ(refusal({{0, 0}, {0.3, 0.1}, {0.3, up}}), "accepted");
}

Ring star(std::size_t n, double inner, double outer) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double r = i % 2 == 0 ? outer : inner;
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return ring;
}

TEST(Polygon, AHundredThousandPointsAreJudged) {
  EXPECT_TRUE(make_polygon(star(100'000, 1.0, 2.0)).has_value());
  const auto more = make_polygon(star(100'002, 1.0, 2.0));
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::kLimit);
}

TEST(Polygon, ManyCrossingsAreRefusedAtTheFirst) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  Ring ring;
  for (int i = 0; i < 100'000; ++i) ring.emplace_back(place(random), place(random));
  EXPECT_THAT(refusal(ring), HasSubstr("crosses"));
}

/// Brute force: does any pair of edges that are no neighbours meet?
bool is_simple_by_pairs(const Ring& ring) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const auto side = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const auto& c) {
    const double s = cross(b - a, c - a);
    return s > 0 ? 1 : s < 0 ? -1 : 0;
  };
  const auto on = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const auto& p) {
    return side(a, b, p) == 0 && (p - a).dot(p - b) <= 0;
  };
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;
      const Eigen::Vector2d &a = ring[i], &b = ring[i + 1], &c = ring[k], &d = ring[(k + 1) % n];
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return false;
      if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return false;
    }
  }
  return true;
}

TEST(Polygon, TheSweepAgreesWithAllPairs) {
  // Small whole coordinates: touching, vertical and collinear edges are frequent, products exact.
  std::mt19937 random(3);
  int num_simple = 0;
  for (int round = 0; round < 20'000; ++round) {
    Ring ring;
    const int n = 3 + static_cast<int>(random() % 6);
    for (int i = 0; i < n; ++i) {
      ring.emplace_back(static_cast<double>(random() % 6), static_cast<double>(random() % 6));
    }
    const auto polygon = make_polygon(ring);
    if (!polygon && (polygon.error().what.find("spike") != std::string::npos ||
                     polygon.error().what.find("distinct") != std::string::npos)) {
      continue;
    }
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.front() == ring.back()) ring.pop_back();
    ASSERT_EQ(polygon.has_value(), is_simple_by_pairs(ring)) << "round " << round;
    num_simple += polygon ? 1 : 0;
  }
  EXPECT_GT(num_simple, 1000);
}

TEST(ConvexHull, InnerAndCollinearPointsAreLeftOut) {
  const std::vector<Eigen::Vector2d> points{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}};
  const Polygon hull = convex_hull(points).value();
  EXPECT_EQ(hull.outer, (Ring{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_FALSE(convex_hull(std::span(points).first(3)).has_value());
  EXPECT_FALSE(convex_hull({}).has_value());
}

TEST(Polygon, SimplifyingLeavesCornersOutThatAreNearTheNewOutline) {
  const Polygon steps =
      *make_polygon({{0, 0}, {2, 0}, {4, 0.01}, {4, 4}, {2, 4.01}, {0, 4}, {0.3, 2}});
  const Polygon simple = simplified(steps, 0.05);
  EXPECT_EQ(simple.outer.size(), 5U) << "the corner at 0.3 is too far off to go";
  EXPECT_NEAR(area_m2(simple), area_m2(steps), 0.05);
  EXPECT_EQ(simplified(steps, 0.0).outer.size(), steps.outer.size());
  EXPECT_EQ(simplified(steps, 100.0), steps) << "nothing would be left";
}

}  // namespace
}  // namespace hypermap
