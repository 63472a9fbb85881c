// SPDX-License-Identifier: BSD-3-Clause
// Long because: one type, each of its rules with numbers worked by hand.
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::only;
using testing_support::surface_of;

TEST(OccupancyVotes, PointsFallIntoCellsByTheFloor) {
  // [smap] Eq. (3.8), restored: floor(p / S_leaf); -0.001 / 0.01 lies in cell -1.
  OccupancyVotes points;
  points.observe(std::vector<Eigen::Vector3f>{{-0.001F, 0.001F, 0.0199F}});
  ASSERT_EQ(points.state().votes.size(), 1U);
  EXPECT_EQ(points.state().votes[0].cell, (PointCell{-1, 0, 1}));
}

TEST(OccupancyVotes, CellsAreSortedAndUniqueHoweverFarApartTheyLie) {
  std::mt19937 random(67);
  std::uniform_real_distribution<float> within(-0.4F, 0.4F);
  for (const float far_m : {0.0F, 30'000.0F}) {  // the second lies 3 million cells away
    std::vector<Eigen::Vector3f> points{{far_m, -far_m, 0.0F}};
    for (int i = 0; i < 900; ++i) points.emplace_back(within(random), within(random), 0.05F);
    std::set<PointCell> expected;
    const double edge_m = OccupancyVotesOptions{}.edge_m;
    for (const Eigen::Vector3f& p : points) {
      const auto cell = [&](int axis) {
        return static_cast<std::int32_t>(std::floor(static_cast<double>(p[axis]) / edge_m));
      };
      expected.insert({cell(0), cell(1), cell(2)});
    }
    OccupancyVotes evidence;
    evidence.observe(points);
    std::vector<PointCell> cells;
    for (const PointVote& vote : evidence.state().votes) cells.push_back(vote.cell);
    EXPECT_EQ(cells, std::vector<PointCell>(expected.begin(), expected.end())) << far_m;
  }
}

TEST(OccupancyVotes, AnObservationVotesOncePerCell) {
  OccupancyVotes points;
  points.observe(std::vector<Eigen::Vector3f>{{0.001F, 0, 0}, {0.002F, 0, 0}, {0.011F, 0, 0}});
  points.observe(std::vector<Eigen::Vector3f>{{0.005F, 0, 0}});
  ASSERT_EQ(points.state().votes.size(), 2U);
  EXPECT_EQ(points.state().votes[0].votes, 2U);
  EXPECT_EQ(points.state().votes[1].votes, 1U);
  EXPECT_EQ(points.state().num_observations, 2U);
}

TEST(OccupancyVotes, TheFootprintIsThatOfTheThing) {
  const Box box = box_at({1.0, 2.0, 0.5}, {0.5, 0.4, 1.0});
  OccupancyVotes points;
  for (int i = 0; i < 5; ++i) points.observe(surface_of(box));
  const Polygon truth = make_polygon({{0.75, 1.8}, {1.25, 1.8}, {1.25, 2.2}, {0.75, 2.2}}).value();
  EXPECT_GT(jaccard(points.footprint().value(), truth), 0.85);
}

/// A plane of 2 m by 2 m, of which 30 observations see another 2,000 points each, and two of them
/// the same points, 4 cm apart, of a strip of 0.2 m beyond its end as well.
OccupancyVotes observed_plane(const OccupancyVotesOptions& options) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> within(0.0F, 2.0F);
  std::vector<Eigen::Vector3f> strip;
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d p(2.305 + 0.04 * i, 0.005 + 0.04 * k, 0.505);
      strip.push_back(p.cast<float>());
    }
  }
  OccupancyVotes plane(options);
  for (int frame = 0; frame < 30; ++frame) {
    std::vector<Eigen::Vector3f> seen;
    seen.reserve(2000 + strip.size());
    for (int i = 0; i < 2000; ++i) seen.emplace_back(within(random), within(random), 0.505F);
    if (frame < 2) seen.insert(seen.end(), strip.begin(), strip.end());
    plane.observe(seen);
  }
  return plane;
}

TEST(OccupancyVotes, OfALargeSurfaceTheBlocksTellWhatTwoSegmentsTookIn) {
  // 60,000 points in 40,000 cells: the typical cell has two votes, as those of the strip have.
  const auto right_end = [](double min_block_share) {
    const auto plane = observed_plane({.max_cells = 65536, .min_block_share = min_block_share});
    return plane.agreed_box()->max_in_map.x();
  };
  EXPECT_NEAR(right_end(0.1), 2.0, 0.02);
  EXPECT_NEAR(right_end(0.0), 2.465, 0.02);
}

TEST(OccupancyVotes, SupportedAreTheCellsOfASurfaceThatOnlyOneSaw) {
  const OccupancyVotes plane = observed_plane({.max_cells = 65536});
  const auto supported = plane.supported_points();
  EXPECT_GT(2 * supported.size(), 3 * plane.agreed_points().size());
  EXPECT_TRUE(std::ranges::none_of(supported, [](const auto& p) { return p.x() > 2.01; }));
  EXPECT_EQ(plane.standings().size(), plane.state().votes.size());
}

TEST(OccupancyVotes, StrayPointsAreOutvoted) {
  const Box box = box_at({0.0, 0.0, 0.5}, {0.4, 0.4, 1.0});
  std::mt19937 random(5);
  std::uniform_real_distribution<float> far(-1.5F, 1.5F);
  OccupancyVotes points;
  for (int frame = 0; frame < 40; ++frame) {
    auto seen = surface_of(box);
    for (int i = 0; i < 100; ++i) seen.emplace_back(far(random), far(random), far(random));
    points.observe(seen);
  }
  const Polygon truth = make_polygon({{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}).value();
  EXPECT_GT(jaccard(points.footprint().value(), truth), 0.85);
  EXPECT_LT(points.agreed_box()->extent().maxCoeff(), 1.05);
}

TEST(OccupancyVotes, ASideSeenSeldomStays) {
  const auto all = surface_of(box_at({0.0, 0.0, 0.5}, {0.6, 0.6, 1.0}));
  OccupancyVotes points;
  for (int i = 0; i < 30; ++i) points.observe(only(all, [](const auto& p) { return p.y() < 0; }));
  for (int i = 0; i < 8; ++i) points.observe(only(all, [](const auto& p) { return p.y() > 0; }));
  EXPECT_NEAR(points.agreed_box()->extent().y(), 0.6, 0.03);
}

/// Centres of 4 x 4 cells of 1 cm, one block of `z_cell`'s layer.
std::vector<Eigen::Vector3f> sheet_of_cells(float z_cell) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(16);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const Eigen::Vector3f cell(static_cast<float>(x), static_cast<float>(y), z_cell);
      points.emplace_back(0.01F * (cell.array() + 0.5F));
    }
  }
  return points;
}

TEST(OccupancyVotes, WhatIsSeenSeldomCountsWhereNothingIsSeenOften) {
  // A table's top (layer 41) seen 40 times, noise above it (42) and a leg (layer 0) 6 times: a
  // typical cell has 40 votes, so that 10 are needed. The leg's block has 96 of 736 and more than a
  // tenth of the top's; its best cell has 6, so that 2 are needed there. A tenth of 16 x 46 = 736
  // is 73.6: what two observations saw elsewhere, 32, is a stray.
  OccupancyVotes points;
  for (int i = 0; i < 40; ++i) {
    auto seen = sheet_of_cells(41);
    const auto add = [&](float z_cell) {
      const auto more = sheet_of_cells(z_cell);
      seen.insert(seen.end(), more.begin(), more.end());
    };
    if (i < 6) add(42);
    if (i >= 30 && i < 36) add(0);
    if (i >= 38) add(80);
    points.observe(seen);
  }
  EXPECT_EQ(points.agreement().typical_votes, 40U);
  EXPECT_EQ(points.agreement().num_cells, 32U);
  EXPECT_EQ(points.agreement().low.z, 0);
  EXPECT_EQ(points.agreement().high.z, 41);
}

TEST(OccupancyVotes, LargeThingsGetLargerCellsAndMemoryStaysFlat) {
  OccupancyVotes points;
  for (int i = 0; i < 10; ++i) points.observe(surface_of(box_at({0, 0, 0.5}, {2.0, 1.0, 1.0})));
  EXPECT_LE(points.state().votes.size(), points.options().max_cells);
  EXPECT_GT(points.state().edge_m, points.options().edge_m);
  EXPECT_NEAR(points.agreed_box()->extent().x(), 2.0, 0.05);
}

TEST(OccupancyVotes, WhatIsSeenLastOfALargeThingIsOfItToo) {
  // A wall of 4 x 2 m has 80,000 cells, and an observation 2,000 points: most cells have one vote
  // when the last quarter comes into view.
  OccupancyVotes points;
  CounterRng random(1, 2);
  const auto observe = [&](double from_m, double to_m) {
    std::vector<Eigen::Vector3f> seen;
    seen.reserve(2000);
    for (int i = 0; i < 2000; ++i) {
      seen.emplace_back(static_cast<float>(random.uniform(from_m, to_m)),
                        0.005F,
                        static_cast<float>(random.uniform(0.0, 2.0)));
    }
    points.observe(seen);
  };
  for (int i = 0; i < 30; ++i) observe(0.0, 3.0);
  for (int i = 0; i < 10; ++i) observe(1.0, 4.0);
  EXPECT_NEAR(points.agreed_box()->max_in_map.x(), 4.0, 0.05);
  const auto of_quarter = [&](double from_m) {
    const auto agreed = points.agreed_points();
    return std::ranges::count_if(agreed, [&](const Eigen::Vector3d& point) {
      return point.x() > from_m && point.x() < from_m + 1.0;
    });
  };
  EXPECT_GT(of_quarter(3.0), of_quarter(0.0) / 2);
}

TEST(OccupancyVotes, StraysSideBySideDoNotAgreeWhenCellsWiden) {
  // One observation in twenty is twice as long; the cells are doubled on the way.
  OccupancyVotes points;
  for (int i = 0; i < 60; ++i) {
    const double length = i % 20 == 3 ? 4.0 : 2.0;
    points.observe(surface_of(box_at({0, 0, 0.5}, {length, 1.0, 1.0}), 0.015));
  }
  EXPECT_GT(points.state().edge_m, points.options().edge_m);
  EXPECT_NEAR(points.agreed_box()->extent().x(), 2.0, 0.08);
}

TEST(OccupancyVotes, MergingAddsVotesAcrossCellSizes) {
  OccupancyVotes large;
  large.observe(surface_of(box_at({0, 0, 0.5}, {2.0, 1.0, 1.0})));
  OccupancyVotes small;
  small.observe(surface_of(box_at({0, 0, 1.05}, {0.1, 0.1, 0.1})));
  OccupancyVotes both = large;
  both.merge(small);
  EXPECT_EQ(both.state().num_observations, 2U);
  EXPECT_GT(both.agreed_box()->max_in_map.z(), 1.05);
  small.merge(large);
  EXPECT_EQ(small.state(), both.state());
}

/// A wall along x, from one place to another.
std::vector<Eigen::Vector3f> wall(double from_m, double to_m) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; from_m + 0.01 * i < to_m; ++i) {
    for (int k = 0; k < 10; ++k) {
      points.emplace_back(static_cast<float>(from_m + 0.01 * i + 0.005),
                          0.0F,
                          0.01F * static_cast<float>(k) + 0.005F);
    }
  }
  return points;
}

TEST(OccupancyVotes, CellsThatAnotherObjectAgreesOnMoreGoToIt) {
  // One was seen ten times up to 1 m and four times 0.3 m farther; the other one begins at 1 m and
  // was seen five times: 5 of its typical 5 votes are more than 1.5 times 4 of 10.
  OccupancyVotes one;
  for (int i = 0; i < 6; ++i) one.observe(wall(0.0, 1.0));
  for (int i = 0; i < 4; ++i) one.observe(wall(0.0, 1.3));
  OccupancyVotes other;
  for (int i = 0; i < 5; ++i) other.observe(wall(1.0, 1.5));
  EXPECT_NEAR(one.agreed_box()->max_in_map.x(), 1.3, 0.01);
  EXPECT_EQ(one.yield_to(other, 3.0), 0U) << "2.5 times as much is not enough";
  OccupancyVotes kept = other;
  EXPECT_EQ(kept.yield_to(one, 1.5), 0U) << "0.4 is less than 1";
  EXPECT_EQ(one.yield_to(other, 1.5), 300U);
  EXPECT_NEAR(one.agreed_box()->max_in_map.x(), 1.0, 0.01);
  EXPECT_EQ(one.state().num_observations, 10U);
  EXPECT_EQ(one.yield_to(other, 1.5), 0U) << "nothing is contested any more";
}

TEST(OccupancyVotes, CellsOfTwoSizesAreComparedByThePlace) {
  OccupancyVotes large(OccupancyVotesOptions{.max_cells = 1024});
  for (int i = 0; i < 6; ++i) large.observe(wall(-1.0, 1.0));
  for (int i = 0; i < 4; ++i) large.observe(wall(-1.0, 1.3));
  ASSERT_GT(large.state().edge_m, 0.01);
  OccupancyVotes small;
  for (int i = 0; i < 5; ++i) small.observe(wall(1.0, 1.3));
  ASSERT_EQ(small.state().edge_m, 0.01);
  EXPECT_EQ(OccupancyVotes(small).yield_to(large, 1.5), 0U);
  EXPECT_GT(large.yield_to(small, 1.5), 0U);
  EXPECT_NEAR(large.agreed_box()->max_in_map.x(), 1.0, large.state().edge_m);
}

/// Box and number of the agreed points, from the points themselves.
void expect_agreement_of_points(const OccupancyVotes& votes) {
  const std::vector<Eigen::Vector3d> points = votes.agreed_points();
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(votes.agreement().num_cells, points.size());
  Box box{points.front(), points.front()};
  for (const Eigen::Vector3d& p : points) {
    box.min_in_map = box.min_in_map.cwiseMin(p);
    box.max_in_map = box.max_in_map.cwiseMax(p);
  }
  box.min_in_map.array() -= 0.25 * votes.state().edge_m;
  box.max_in_map.array() += 0.25 * votes.state().edge_m;
  EXPECT_EQ(*votes.agreed_box(), box);
  EXPECT_EQ(OccupancyVotes::from_state(votes.options(), votes.state())->agreement(),
            votes.agreement());
}

TEST(OccupancyVotes, WhatIsKnownOfTheAgreedCellsFollowsEveryChange) {
  EXPECT_EQ(OccupancyVotes().agreement(), CellAgreement());
  std::mt19937 random(8);
  std::uniform_real_distribution<float> by(-0.3F, 0.3F);
  OccupancyVotes one(OccupancyVotesOptions{.max_cells = 1024});
  OccupancyVotes other = one;
  std::size_t num_given_up = 0;
  for (int i = 0; i < 20; ++i) {
    // A side at y = 0, where the other object's wall stands too.
    auto seen = surface_of(box_at({0, 0.15, 0.1}, {0.4, 0.3, 0.2}));
    for (Eigen::Vector3f& p : seen) p.x() += i % 4 == 3 ? by(random) : 0.0F;
    one.observe(seen);
    expect_agreement_of_points(one);
    other.observe(wall(0.1, 0.2 + 0.05 * i));
    const OccupancyVotes before = one;
    num_given_up += one.yield_to(other, 1.5);
    expect_agreement_of_points(one);
    expect_agreement_of_points(before);
  }
  EXPECT_GT(num_given_up, 0U);
  EXPECT_GT(one.state().edge_m, one.options().edge_m);
  one.merge(other);
  expect_agreement_of_points(one);
}

TEST(OccupancyVotes, CellsBesideThoseOfAnotherGoToItByTheBlock) {
  // Ours: 40 votes of a cell far away, 6 of cell (0, 0, 0). Theirs: 34 of its neighbour (1, 0, 0).
  // 6 / 40 times 1.5 is less than 34 / 34, but no cell is in both.
  const Eigen::Vector3f far_away{1.005F, 0.005F, 0.005F};
  const Eigen::Vector3f contested{0.005F, 0.005F, 0.005F};
  OccupancyVotes ours;
  for (int i = 0; i < 34; ++i) ours.observe(std::vector{far_away});
  for (int i = 0; i < 6; ++i) ours.observe(std::vector{far_away, contested});
  OccupancyVotes theirs;
  for (int i = 0; i < 34; ++i) theirs.observe(std::vector{Eigen::Vector3f{0.015F, 0.005F, 0.005F}});
  EXPECT_EQ(ours.yield_to(theirs, 1.5), 0U);
  EXPECT_EQ(ours.yield_to(theirs, 1.5, ContestedPlace::kBlock), 1U);
  ASSERT_EQ(ours.state().votes.size(), 1U);
  EXPECT_EQ(ours.state().votes[0].cell, (PointCell{100, 0, 0}));
}

TEST(OccupancyVotes, NothingIsGivenUpToNobodyAndNotEverything) {
  OccupancyVotes one;
  one.observe(wall(0.0, 0.5));
  OccupancyVotes same = one;
  EXPECT_EQ(one.yield_to(OccupancyVotes(), 1.5), 0U);
  EXPECT_EQ(OccupancyVotes().yield_to(one, 1.5), 0U);
  EXPECT_EQ(one.yield_to(same, 1.0), 0U) << "all of them are contested: none would be left";
  EXPECT_EQ(one, same);
}

// Votes of cells 0 to 3: 3, 3, 1, 2.
TEST(OccupancyVotes, DeniedCellsLoseAVoteAndGoWithTheLast) {
  const auto at = [](int cell) {
    return Eigen::Vector3f(0.01F * static_cast<float>(cell) + 0.005F, 0.005F, 0.005F);
  };
  OccupancyVotes votes;
  votes.observe(std::vector{at(0), at(1), at(2), at(3)});
  votes.observe(std::vector{at(0), at(1), at(3)});
  votes.observe(std::vector{at(0), at(1)});
  const OccupancyVotes before = votes;
  votes.deny(std::vector<std::size_t>{1, 2});
  EXPECT_EQ(votes.state().votes,
            (std::vector<PointVote>{{{0, 0, 0}, 3}, {{1, 0, 0}, 2}, {{3, 0, 0}, 2}}));
  EXPECT_EQ(votes.state().num_observations, 3U);
  expect_agreement_of_points(votes);
  EXPECT_EQ(before.state().votes.size(), 4U) << "a copy keeps its own";
  votes.deny({});
  votes.deny(std::vector<std::size_t>{0, 1, 2});
  votes.deny(std::vector<std::size_t>{0, 1, 2});
  EXPECT_EQ(votes.state().votes, (std::vector<PointVote>{{{0, 0, 0}, 1}}));
  votes.deny(std::vector<std::size_t>{0});
  EXPECT_EQ(votes.state().votes, (std::vector<PointVote>{{{0, 0, 0}, 1}})) << "the last one stays";
}

TEST(OccupancyVotes, PointsThatAreNoneAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  OccupancyVotes points;
  points.observe(std::vector<Eigen::Vector3f>{{nan, 0, 0}, {1e30F, 0, 0}});
  EXPECT_TRUE(points.empty());
  EXPECT_FALSE(points.agreed_box().has_value());
  EXPECT_EQ(points.footprint().error().code, ErrorCode::kNotFound);
}

TEST(OccupancyVotes, OnePointHasAFootprint) {
  OccupancyVotes points;
  points.observe(std::vector<Eigen::Vector3f>{{0.0F, 0.0F, 0.0F}});
  // A square of half a cell: 0.005^2.
  EXPECT_NEAR(area_m2(points.footprint().value()), 2.5e-5, 1e-9);
}

TEST(OccupancyVotes, WhatIsStoredComesBackAndNonsenseIsRefused) {
  OccupancyVotes points;
  points.observe(surface_of(box_at({0, 0, 0}, {1, 1, 1})));
  EXPECT_EQ(OccupancyVotes::from_state(points.options(), points.state()).value(), points);
  OccupancyVotesState edge = points.state();
  edge.edge_m *= 1.5;
  EXPECT_EQ(OccupancyVotes::from_state({}, edge).error().field, "points.edge_m");
  OccupancyVotesState disordered = points.state();
  std::swap(disordered.votes[0], disordered.votes[1]);
  EXPECT_FALSE(OccupancyVotes::from_state({}, disordered).has_value());
  OccupancyVotesState infinite = points.state();
  infinite.edge_m = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(OccupancyVotes::from_state({}, infinite).has_value());
  EXPECT_EQ(validate(OccupancyVotesOptions{.edge_m = 0.0}).error().field, "edge_m");
}

TEST(OccupancyVotes, TheFootprintIsTheHullOfAllAgreedPoints) {
  std::mt19937 random(5);
  std::normal_distribution<float> place(0.0F, 0.2F);
  for (int turn = 0; turn < 20; ++turn) {
    OccupancyVotes votes;
    std::vector<Eigen::Vector3f> points(static_cast<std::size_t>(1 + 20 * turn));
    for (auto& p : points) p = {place(random), place(random), place(random)};
    votes.observe(points);
    std::vector<Eigen::Vector2d> corners;
    for (const Eigen::Vector3d& p : votes.agreed_points()) {
      for (const double dx : {-0.0025, 0.0025}) {
        for (const double dy : {-0.0025, 0.0025}) corners.emplace_back(p.x() + dx, p.y() + dy);
      }
    }
    EXPECT_EQ(votes.footprint().value(), convex_hull(corners).value()) << turn;
  }
}

}  // namespace
}  // namespace hypermap
