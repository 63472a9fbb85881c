// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

TEST(PolygonBudget, TheSearchForHolesIsDrawn) {
  const Ring outer{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  const std::vector<Ring> holes{{{1, 1}, {2, 1}, {1, 2}}, {{5, 5}, {6, 5}, {5, 6}}};
  // Each hole against the boxes of both and the four edges of the outer ring: 2 * (2 + 4).
  EXPECT_TRUE(make_polygon(outer, holes, LoadBudget({.max_edge_tests = 12})));
  const auto refused = make_polygon(outer, holes, LoadBudget({.max_edge_tests = 11}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_TRUE(make_polygon(outer, {}, LoadBudget({.max_edge_tests = 0})));
}

TEST(PolygonBudget, TheSearchForRingsThatTouchIsDrawn) {
  const Ring outer{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const std::vector<Ring> holes{{{0, 0}, {1, 3}, {3, 1}}};
  // 21 pairs of seven edges, then the hole against one box and the four edges of the outer ring.
  EXPECT_TRUE(make_polygon(outer, holes, LoadBudget({.max_edge_tests = 26})));
  for (const std::uint64_t limit : {25U, 20U, 0U}) {
    const auto refused = make_polygon(outer, holes, LoadBudget({.max_edge_tests = limit}));
    ASSERT_FALSE(refused) << limit;
    EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  }
}

TEST(PolygonBudget, PairsOfEdgesAndCrossingsAreDrawn) {
  // A pentagram has 10 pairs of edges and 5 crossings of 500 tests each.
  Ring star;
  for (int i = 0; i < 5; ++i) {
    const double angle = 4.0 * std::numbers::pi * i / 5.0;
    star.emplace_back(std::cos(angle), std::sin(angle));
  }
  EXPECT_TRUE(resolve_winding(star, LoadBudget({.max_edge_tests = 2510})));
  const auto refused = resolve_winding(star, LoadBudget({.max_edge_tests = 2509}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_TRUE(resolve_winding({{0, 0}, {1, 0}, {1, 1}}, LoadBudget({.max_edge_tests = 0})));
}

TEST(PolygonBudget, TheSearchForTheOwnerOfAHoleIsDrawn) {
  // A strip around a square hole whose ends lie across each other.
  const Ring strip{
      {-1, 0}, {6, 0}, {6, 6}, {0, 6}, {0, -1}, {1, -1}, {1, 5}, {5, 5}, {5, 1}, {-1, 1}};
  // 45 pairs of edges and 4 crossings; the hole's owner has 10 corners, which are gone through once
  // for its area and once for each of the hole's 4.
  constexpr std::uint64_t kTests = 45 + 4 * 500 + 10 + 4 * 10;
  const auto fill = resolve_winding(strip, LoadBudget({.max_edge_tests = kTests}));
  ASSERT_TRUE(fill) << fill.error().what;
  ASSERT_EQ(fill->parts.size(), 1U);
  EXPECT_EQ(fill->parts[0].outer.size(), 10U);
  EXPECT_EQ(fill->parts[0].holes.size(), 1U);
  EXPECT_FALSE(resolve_winding(strip, LoadBudget({.max_edge_tests = kTests - 1})));
}

}  // namespace
}  // namespace hypermap
