// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/stack_services.hpp"

#include "grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::grid_of;
using test::pose;
using test::random_grid;
using test::sized;
using testing::ElementsAre;
using testing::HasSubstr;

GridStack random_stack(const GridGeometry& geometry,
                       const std::vector<std::string>& names,
                       int max_steps = 3000) {
  GridStack stack = GridStack::create(geometry).value();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const LogOddsGrid grid = random_grid(geometry, 100 + i, max_steps);
    EXPECT_TRUE(stack.fuse({.layer = names[i], .grid = grid}, pose(0, 0)));
  }
  return stack;
}

std::vector<std::string> names_of(const GridStack& stack) {
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack.layers()) names.push_back(name);
  return names;
}

/// Of the layers of one cell that know it.
std::vector<double> known_probabilities(const GridStack& stack, std::size_t cell) {
  std::vector<double> known;
  for (const auto& [name, grid] : stack.layers()) {
    const LogOddsSteps steps = grid.cells()[cell];
    if (steps != 0) known.push_back(from_steps(steps).probability().value());
  }
  return known;
}

TEST(Pooling, IsThePrintedFormulaOnRandomStacks) {
  // [sogm] Eq. (6): P_B = 1 / (1 + prod (1 - P) / P), P_M = max P, over the layers that know a
  // cell.
  for (const auto& names : std::vector<std::vector<std::string>>{
           {"/ism/a"}, {"/ism/a", "/ism/b"}, {"/ism/a", "/ism/b", "/ism/c", "/ism/d", "/ism/e"}}) {
    const GridStack stack = random_stack(sized(13, 6), names, 2500);
    const LogOddsGrid bayesian = pooled(stack, Pooling::kBayesian).value();
    const LogOddsGrid maximum = pooled(stack, Pooling::kMaximum).value();
    for (std::size_t i = 0; i < bayesian.cells().size(); ++i) {
      const std::vector<double> known = known_probabilities(stack, i);
      if (known.empty()) {
        EXPECT_EQ(bayesian.cells()[i], 0);
        EXPECT_EQ(maximum.cells()[i], 0);
        continue;
      }
      double product = 1.0;
      for (const double p : known) product *= (1.0 - p) / p;
      EXPECT_NEAR(
          from_steps(bayesian.cells()[i]).probability().value(), 1.0 / (1.0 + product), 1e-9);
      EXPECT_NEAR(from_steps(maximum.cells()[i]).probability().value(),
                  *std::ranges::max_element(known),
                  1e-12);
    }
  }
}

TEST(Pooling, AHandWorkedCell) {
  // [sogm] Eq. (6): P = 0.8 and 0.7: P_B = 1 / (1 + 0.25 * 3/7) = 0.903 2, P_M = 0.8; of 0.8 and
  // 0.1: P_B = 1 / (1 + 0.25 * 9) = 0.307 7, P_M = 0.8. A layer that knows nothing changes neither,
  // not even to 0.5 where the other says 0.1.
  GridStack stack = GridStack::create(sized(3, 1)).value();
  const auto add = [&](const char* layer, const std::vector<double>& p) {
    const LogOddsGrid grid = LogOddsGrid::of_probabilities(sized(3, 1), p).value();
    ASSERT_TRUE(stack.fuse({.layer = layer, .grid = grid}, pose(0, 0)));
  };
  add("/ism/a", {0.8, 0.8, 0.1});
  add("/ism/b", {0.7, 0.1, 0.5});
  const auto p = [&](Pooling rule, int col) {
    return pooled(stack, rule).value().log_odds({col, 0}).probability().value();
  };
  EXPECT_NEAR(p(Pooling::kBayesian, 0), 0.9032, 2e-4);
  EXPECT_NEAR(p(Pooling::kMaximum, 0), 0.8, 2e-4);
  EXPECT_NEAR(p(Pooling::kBayesian, 1), 0.3077, 2e-4);
  EXPECT_NEAR(p(Pooling::kMaximum, 1), 0.8, 2e-4);
  EXPECT_NEAR(p(Pooling::kBayesian, 2), 0.1, 2e-4);
  EXPECT_NEAR(p(Pooling::kMaximum, 2), 0.1, 2e-4);
}

TEST(Pooling, SaturatesInsteadOfOverflowingAndKnowsNothingOfNothing) {
  GridStack stack = GridStack::create(sized(1, 1)).value();
  EXPECT_THAT(pooled(stack, Pooling::kMaximum).value().cells(), ElementsAre(0));
  for (const char* name : {"/ism/a", "/ism/b", "/ism/c"}) {
    const LogOddsGrid sure = grid_of(sized(1, 1), {kMaxLogOddsSteps});
    ASSERT_TRUE(stack.fuse({.layer = name, .grid = sure}, pose(0, 0)));
  }
  EXPECT_THAT(pooled(stack, Pooling::kBayesian).value().cells(), ElementsAre(kMaxLogOddsSteps));
}

TEST(CutOut, GivesTheStackItselfOnItsOwnCells) {
  const GridStack stack = random_stack(sized(9, 5), {"/ism/a", "/ism/b"}, 13'000);
  EXPECT_EQ(cut_out(stack, {.geometry = stack.geometry()}).value(), stack);
  std::vector<std::size_t> last_call;
  const JobProgress until_first = [&last_call](std::size_t done, std::size_t total) {
    last_call = {done, total};
    return false;
  };
  EXPECT_EQ(cut_out(stack, {.geometry = stack.geometry()}, until_first).error().code,
            ErrorCode::kInterrupted);
  EXPECT_THAT(last_call, testing::ElementsAre(1U, stack.layers().size()));
}

TEST(CutOut, PoseSizeAndResolutionAreThoseAskedFor) {
  const GridStack stack = random_stack(sized(20, 12), {"/ism/a"});
  const LogOddsGrid& layer = stack.layers().at("/ism/a");
  GridGeometry part = sized(3, 2);
  part.origin = {0.5, 0.4};
  const GridStack cut = cut_out(stack, {.geometry = part}).value();
  EXPECT_EQ(cut.geometry(), part);
  EXPECT_EQ(cut.layers().at("/ism/a").at({2, 1}), layer.at({7, 5}));
  // As resampled itself gives it, turned and coarser.
  const GridGeometry turned{
      .resolution_m = 0.23, .origin = {0.9, 0.1}, .yaw_rad = 0.6, .cols = 4, .rows = 3};
  EXPECT_EQ(cut_out(stack, {.geometry = turned}).value().layers().at("/ism/a"),
            resampled(layer, turned, pose(0, 0)).value());
}

TEST(CutOut, ANameStandsForTheLayersBelowIt) {
  const GridStack stack = random_stack(sized(2, 2), {"/ism/a", "/ism/a/b", "/ism/ab", "/ism/c"});
  const auto cut = [&](std::vector<std::string> layers) {
    return names_of(cut_out(stack, {.geometry = sized(2, 2), .layers = std::move(layers)}).value());
  };
  EXPECT_THAT(cut({"/ism/a"}), ElementsAre("/ism/a", "/ism/a/b"));
  EXPECT_THAT(cut({"/ism/c", "/ism/a/b"}), ElementsAre("/ism/a/b", "/ism/c"));
  EXPECT_THAT(cut({"/ism"}), ElementsAre("/ism/a", "/ism/a/b", "/ism/ab", "/ism/c"));
  const auto failed = cut_out(stack, {.geometry = sized(2, 2), .layers = {"/ism/cx"}});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(failed.error().what, HasSubstr("did you mean \"/ism/c\"?"));
}

TEST(CutOut, WhatCannotBeCutIsSaid) {
  const GridStack stack = random_stack(sized(2, 2), {"/ism/a"});
  GridGeometry far = sized(2, 2);
  far.origin = {7, 7};
  EXPECT_THAT(cut_out(stack, {.geometry = far}).error().what, HasSubstr("lies outside"));
  EXPECT_EQ(cut_out(stack, {.geometry = GridGeometry{}}).error().field, "geometry");
  EXPECT_EQ(cut_out(stack, {.geometry = sized(70'000, 2)}).error().code, ErrorCode::kLimit);
}

TEST(Pooled, OfWhatIsCutOutIsTheCombinedMap) {
  GridStack stack = GridStack::create(sized(2, 1)).value();
  ASSERT_TRUE(stack.fuse({.layer = "/ism/a", .grid = grid_of(sized(2, 1), {1386, 0})}, pose(0, 0)));
  ASSERT_TRUE(
      stack.fuse({.layer = "/ism/b", .grid = grid_of(sized(2, 1), {847, -2197})}, pose(0, 0)));
  // 0.8 and 0.7 as above: 90 per cent; 0.1 alone: 10; outside: unknown.
  const auto combined = [&](const StackRequest& request, Pooling rule) {
    return to_occupancy(pooled(cut_out(stack, request).value(), rule).value()).value();
  };
  EXPECT_THAT(combined({.geometry = sized(3, 1)}, Pooling::kBayesian).cells(),
              ElementsAre(90, 10, kUnknownCell));
  EXPECT_THAT(combined({.geometry = sized(3, 1), .layers = {"/ism/b"}}, Pooling::kMaximum).cells(),
              ElementsAre(70, 10, kUnknownCell));
}

}  // namespace
}  // namespace hypermap
