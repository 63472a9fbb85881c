// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/grid_stack.hpp"

#include "grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::grid_of;
using test::pose;
using test::random_grid;
using test::sized;
using testing::ElementsAre;
using testing::HasSubstr;

GridStack stack_of(const GridGeometry& geometry, GridStackOptions options = {}) {
  return GridStack::create(geometry, std::move(options)).value();
}

SensorGrid reading(std::string layer, LogOddsGrid grid, double weight = 1.0) {
  return {.layer = std::move(layer), .grid = std::move(grid), .weight = weight};
}

const LogOddsGrid& layer_of(const GridStack& stack, const std::string& name) {
  return stack.layers().at(name);
}

TEST(GridStack, ReadingsAreMultipliedAsOdds) {
  // [sogm] Eq. (1): P = 0.7 twice and P = 0.4 once on one cell: (0.7/0.3)^2 (0.4/0.6) = 3.629 63,
  // P = 0.784 0. The other cell is known to the first alone.
  GridStack stack = stack_of(sized(2, 1));
  const auto says = [&](double a, double b) {
    const auto grid = LogOddsGrid::of_probabilities(sized(2, 1), std::vector{a, b}).value();
    return stack.fuse(reading("/ism/laser", grid), pose(0, 0)).value();
  };
  EXPECT_EQ(says(0.7, 0.2), 2U);
  EXPECT_EQ(says(0.7, 0.5), 1U);
  EXPECT_EQ(says(0.4, 0.5), 1U);
  const LogOddsGrid& layer = layer_of(stack, "/ism/laser");
  EXPECT_NEAR(layer.log_odds({0, 0}).probability().value(), 0.7840, 1e-3);
  EXPECT_NEAR(layer.log_odds({1, 0}).probability().value(), 0.2, 1e-3);
}

TEST(GridStack, IsMadeOfLayersThatWereFusedBefore) {
  GridStack stack = stack_of(sized(5, 4));
  ASSERT_TRUE(stack.fuse(reading("/ism/a", random_grid(sized(5, 4), 1, 9000)), pose(0, 0)));
  ASSERT_TRUE(stack.fuse(reading("/ism/a/b", random_grid(sized(5, 4), 2, 9000)), pose(0, 0)));
  EXPECT_EQ(GridStack::create(sized(5, 4), {}, stack.layers()).value(), stack);
  const auto refusal = [&](const char* name, const LogOddsGrid& grid) {
    const auto made =
        GridStack::create(sized(5, 4), {.max_log_odds = LogOdds(9.0)}, {{name, grid}});
    return made ? std::string("none") : to_string(made.error());
  };
  EXPECT_EQ(refusal("/ism/a", layer_of(stack, "/ism/a")), "none");
  EXPECT_THAT(refusal("/ism", layer_of(stack, "/ism/a")), HasSubstr("below /ism/"));
  EXPECT_THAT(refusal("/ism/a", random_grid(sized(4, 5), 1, 9)), HasSubstr("other cells"));
  EXPECT_THAT(refusal("/ism/a", grid_of(sized(5, 4), std::vector<LogOddsSteps>(20, -9001))),
              HasSubstr("at most 9 either way, is -9.001 in cell 0"));
}

TEST(GridStack, TheOrderOfReadingsDoesNotCount) {
  // [sogm] Eq. (1): a product. Sensors of any pose, size and resolution, two of three layers.
  std::vector<SensorGrid> readings;
  std::vector<Eigen::Matrix3d> poses;
  for (unsigned i = 0; i < 12; ++i) {
    const GridGeometry geometry = sized(5 + static_cast<int>(i), 9, i % 2 == 0 ? 0.1 : 0.037);
    readings.push_back(reading(i % 3 == 0 ? "/ism/b" : "/ism/a", random_grid(geometry, i, 1000)));
    readings.back().weight = 0.1 * (1 + i % 4);
    poses.push_back(pose(0.05 * i, 0.3 - 0.02 * i, 0.3 * i));
  }
  const auto fused = [&](const std::vector<std::size_t>& order) {
    GridStack stack = stack_of(sized(25, 14));
    for (const std::size_t i : order) EXPECT_TRUE(stack.fuse(readings[i], poses[i]));
    return stack;
  };
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  const GridStack first = fused(order);
  EXPECT_GT(layer_of(first, "/ism/a").num_known(), 60U);
  std::ranges::reverse(order);
  EXPECT_EQ(fused(order), first);
  std::rotate(order.begin(), order.begin() + 5, order.end());
  EXPECT_EQ(fused(order), first);
}

TEST(GridStack, ACellHasAStateInEachLayer) {
  // [sogm] Eq. (2): N layers over the same cells; with N = 2 a cell can be in 3^2 states.
  GridStack stack = stack_of(sized(3, 3));
  const auto fuse = [&](const char* layer, std::vector<LogOddsSteps> cells) {
    EXPECT_TRUE(stack.fuse(reading(layer, grid_of(sized(3, 3), std::move(cells))), pose(0, 0)));
  };
  fuse("/ism/a", {-9, 0, 9, -9, 0, 9, -9, 0, 9});
  fuse("/ism/b", {-9, -9, -9, 0, 0, 0, 9, 9, 9});
  std::set<std::pair<int, int>> states;
  for (std::size_t i = 0; i < 9; ++i) {
    states.emplace(layer_of(stack, "/ism/a").cells()[i], layer_of(stack, "/ism/b").cells()[i]);
  }
  EXPECT_EQ(states.size(), 9U);
}

TEST(GridStack, UnknownCellsStayAsTheyWere) {
  GridStack stack = stack_of(sized(3, 1));
  ASSERT_TRUE(stack.fuse(reading("/ism/a", grid_of(sized(3, 1), {500, 0, -500})), pose(0, 0)));
  const GridStack before = stack;
  EXPECT_EQ(stack.fuse(reading("/ism/a", grid_of(sized(3, 1), {0, 0, 0})), pose(0, 0)), 0U);
  EXPECT_EQ(stack, before);
  // Only what the sensor covers is reached: one cell, at column 2.
  EXPECT_EQ(stack.fuse(reading("/ism/a", grid_of(sized(1, 1), {70})), pose(0.2, 0)), 1U);
  EXPECT_THAT(layer_of(stack, "/ism/a").cells(), ElementsAre(500, 0, -430));
}

TEST(GridStack, AFastSensorDoesNotDrownASlowOneByItsWeight) {
  // Ten readings of weight 1/10 say as much as one of weight 1 that says the opposite.
  GridStack stack = stack_of(sized(1, 1));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(stack.fuse(reading("/ism/a", grid_of(sized(1, 1), {2000}), 0.1), pose(0, 0)));
  }
  EXPECT_EQ(layer_of(stack, "/ism/a").at({0, 0}), 2000);
  ASSERT_TRUE(stack.fuse(reading("/ism/a", grid_of(sized(1, 1), {-2000})), pose(0, 0)));
  EXPECT_EQ(layer_of(stack, "/ism/a").at({0, 0}), 0);
}

TEST(GridStack, EvidenceSaturatesAndIsForgottenAsAsked) {
  GridStack bounded = stack_of(sized(1, 1), {.max_log_odds = LogOdds(3.0)});
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(bounded.fuse(reading("/ism/a", grid_of(sized(1, 1), {2000})), pose(0, 0)));
  }
  EXPECT_EQ(layer_of(bounded, "/ism/a").at({0, 0}), 3000);
  // 1000, then 0.5 * 1000 + 1000 = 1500, then 1750; and 0.5 * 1750 - 1000 = -125. A cell that the
  // sensor does not know forgets nothing.
  GridStack forgetful = stack_of(sized(2, 1), {.keep_share = 0.5});
  ASSERT_TRUE(forgetful.fuse(reading("/ism/a", grid_of(sized(2, 1), {1000, 900})), pose(0, 0)));
  for (const int steps : {1000, 1000, -1000}) {
    const LogOddsGrid grid = grid_of(sized(2, 1), {static_cast<LogOddsSteps>(steps), 0});
    ASSERT_TRUE(forgetful.fuse(reading("/ism/a", grid), pose(0, 0)));
  }
  EXPECT_THAT(layer_of(forgetful, "/ism/a").cells(), ElementsAre(-125, 900));
}

TEST(GridStack, LayersAreMadeOnDemandBelowTheParent) {
  GridStack stack = stack_of(sized(1, 1));
  EXPECT_TRUE(stack.layers().empty());
  for (const char* name : {"/ism/c", "/ism/a", "/ism/a/b"}) {
    EXPECT_TRUE(stack.fuse(reading(name, grid_of(sized(1, 1), {1})), pose(0, 0)));
  }
  std::vector<std::string> names;
  for (const auto& [name, grid] : stack.layers()) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("/ism/a", "/ism/a/b", "/ism/c"));
  const GridStack before = stack;
  for (const std::string& name : {std::string("/other/a"),
                                  std::string("/ism"),
                                  std::string("/ism/"),
                                  std::string("/ismael"),
                                  std::string("/ism//a"),
                                  std::string(),
                                  "/ism/" + std::string(508, 'x')}) {
    const auto failed = stack.fuse(reading(name, grid_of(sized(1, 1), {1})), pose(0, 0));
    ASSERT_FALSE(failed) << name;
    EXPECT_EQ(failed.error().field, "layer");
  }
  EXPECT_EQ(stack, before);
}

TEST(GridStack, FramesSayWhereASensorStands) {
  FrameTree frames;
  ASSERT_TRUE(frames.add({.frame_id = "map", .child_frame_id = "robot", .x_m = 0.2}));
  GridStack stack = stack_of(sized(4, 1));
  SensorGrid sensor = reading("/ism/a", grid_of(sized(1, 1), {800}));
  sensor.frame_id = "robot";
  EXPECT_EQ(stack.fuse(sensor, frames), 1U);
  EXPECT_THAT(layer_of(stack, "/ism/a").cells(), ElementsAre(0, 0, 800, 0));
  const GridStack before = stack;
  sensor.frame_id = "moon";
  const auto failed = stack.fuse(sensor, frames);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(to_string(failed.error()), HasSubstr("moon"));
  EXPECT_EQ(stack, before);
}

TEST(GridStack, WhatCannotBeFusedLeavesTheStackAsItWas) {
  GridStack stack = stack_of(sized(4, 3));
  ASSERT_TRUE(stack.fuse(reading("/ism/a", random_grid(sized(4, 3), 1, 500)), pose(0, 0)));
  const GridStack before = stack;
  const LogOddsGrid one = grid_of(sized(1, 1), {1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(stack.fuse(reading("/ism/new", LogOddsGrid()), pose(0, 0)));
  EXPECT_FALSE(stack.fuse(reading("/ism/new", one), pose(9, 9)));
  EXPECT_FALSE(stack.fuse(reading("/ism/new", one), pose(nan, 0)));
  EXPECT_FALSE(stack.fuse(reading("/ism/new", one), pose(0, 0), {.epsilon = Probability(0.5)}));
  for (const double weight : {0.0, -1.0, 1001.0, nan}) {
    const auto failed = stack.fuse(reading("/ism/new", one, weight), pose(0, 0));
    ASSERT_FALSE(failed) << weight;
    EXPECT_EQ(failed.error().field, "weight");
  }
  EXPECT_EQ(stack, before);
}

TEST(GridStack, CellsAreReplacedAsTheyAre) {
  GridStack stack = stack_of(sized(4, 2), {.max_log_odds = LogOdds(9.0), .keep_share = 0.5});
  const LogOddsGrid part = grid_of(sized(2, 2, 7.0), {1, 2, 0, 9000});
  ASSERT_TRUE(stack.replace_cells("/ism/a", part, {1, 0}));
  EXPECT_THAT(layer_of(stack, "/ism/a").cells(), ElementsAre(0, 1, 2, 0, 0, 0, 9000, 0));
  EXPECT_EQ(layer_of(stack, "/ism/a").geometry(), sized(4, 2));
  // Unknown cells take the place of known ones, too; what reaches beyond the stack is left out.
  ASSERT_TRUE(stack.replace_cells("/ism/a", part, {2, -1}));
  EXPECT_THAT(layer_of(stack, "/ism/a").cells(), ElementsAre(0, 1, 0, 9000, 0, 0, 9000, 0));
  ASSERT_TRUE(stack.replace_cells("/ism/a", part, {-1, 1}));
  EXPECT_THAT(layer_of(stack, "/ism/a").cells(), ElementsAre(0, 1, 0, 9000, 2, 0, 9000, 0));
  constexpr int kFar = std::numeric_limits<int>::max();
  for (const Cell outside : {Cell{kFar, kFar}, Cell{-kFar - 1, 0}, Cell{4, 0}, Cell{0, -2}}) {
    const GridStack before = stack;
    ASSERT_TRUE(stack.replace_cells("/ism/a", part, outside));
    EXPECT_EQ(stack, before);
  }
  const GridStack before = stack;
  const auto too_sure = stack.replace_cells("/ism/b", grid_of(sized(2, 1), {1, -9001}));
  ASSERT_FALSE(too_sure);
  EXPECT_EQ(too_sure.error().field, "cells");
  EXPECT_THAT(to_string(too_sure.error()), HasSubstr("is -9.001 in cell 1"));
  EXPECT_EQ(stack.replace_cells("/other/b", part).error().field, "layer");
  EXPECT_EQ(stack, before);
}

TEST(GridStack, OptionsAreChecked) {
  EXPECT_EQ(GridStack::create(GridGeometry{}).error().field, "geometry");
  EXPECT_EQ(GridStack::create(sized(20'000, 20'000)).error().code, ErrorCode::kLimit);
  const auto field_of = [](GridStackOptions options) {
    const auto failed = GridStack::create(sized(1, 1), std::move(options));
    return failed ? std::string() : failed.error().field;
  };
  EXPECT_EQ(field_of({.max_log_odds = LogOdds(0.0)}), "max_log_odds");
  EXPECT_EQ(field_of({.max_log_odds = LogOdds(14.0)}), "max_log_odds");
  EXPECT_EQ(field_of({.keep_share = 1.5}), "keep_share");
  EXPECT_EQ(field_of({.keep_share = std::nan("")}), "keep_share");
  EXPECT_EQ(field_of({.parent = "ism"}), "parent");
  EXPECT_EQ(field_of({.parent = "/"}), "parent");
  EXPECT_EQ(field_of({.frame_id = ""}), "frame_id");
  EXPECT_EQ(field_of({.keep_share = 0.0}), "");
}

}  // namespace
}  // namespace hypermap
