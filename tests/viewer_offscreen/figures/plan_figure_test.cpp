// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/plan_figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

constexpr Rgb8 kMissedRed{205, 30, 30};
constexpr Rgb8 kTruthBlue{0, 90, 181};
constexpr Rgb8 kGreen{20, 130, 60};

Polygon square_about(double x, double y) {
  return make_polygon(
             {{x - 0.5, y - 0.5}, {x + 0.5, y - 0.5}, {x + 0.5, y + 0.5}, {x - 0.5, y + 0.5}})
      .value();
}

ComparedShape shape_at(double x,
                       double y,
                       ComparedFate fate,
                       std::optional<std::size_t> partner = {}) {
  return {.id = 1,
          .class_name = "chair",
          .footprint = square_about(x, y),
          .centroid = {x, y},
          .fate = fate,
          .partner = partner};
}

/// Pixels of a colour above the legend.
int count(const ColorImage& image, Rgb8 color) {
  int n = 0;
  for (int v = 0; v < image.height_px() - 92; ++v)
    for (int u = 0; u < image.width_px(); ++u) n += image.at(u, v) == color ? 1 : 0;
  return n;
}

/// Ten metres by ten: 1280 - 80 pixels are 10.8 m wide, so a metre has 111.
ComparedPlan corners() {
  return {.truths = {shape_at(0.5, 0.5, ComparedFate::kMatched, 0),
                     shape_at(9.5, 9.5, ComparedFate::kMatched, 1)},
          .objects = {shape_at(0.5, 0.5, ComparedFate::kMatched, 0),
                      shape_at(9.5, 9.5, ComparedFate::kMatched, 1)}};
}

TEST(PlanFigure, EachFateHasItsMark) {
  const ColorImage matched = draw_compared_plan(corners(), "both").value();
  EXPECT_EQ(count(matched, kMissedRed), 0);
  EXPECT_GT(count(matched, kTruthBlue), 100);
  ComparedPlan plan = corners();
  plan.truths.push_back(shape_at(5, 5, ComparedFate::kMissed));
  const int missed = count(draw_compared_plan(plan, "missed").value(), kMissedRed);
  EXPECT_GT(missed, 50);
  plan.truths.pop_back();
  plan.objects.push_back(shape_at(5, 5, ComparedFate::kFalse));
  EXPECT_GT(count(draw_compared_plan(plan, "false").value(), kMissedRed), 50);
  plan.objects.back().fate = ComparedFate::kApart;
  EXPECT_EQ(count(draw_compared_plan(plan, "apart").value(), kMissedRed), 0);
}

TEST(PlanFigure, WhatBelongsTogetherIsJoined) {
  ComparedPlan plan = corners();
  EXPECT_EQ(count(draw_compared_plan(plan, "in place").value(), kGreen), 0) << "under the dots";
  plan.objects[0].centroid.x() += 0.4;
  plan.objects[0].footprint = square_about(0.9, 0.5);
  EXPECT_GT(count(draw_compared_plan(plan, "beside").value(), kGreen), 30);
}

// Where 8 % of the plan's 10 m are added, half a metre is at 0.9 of 10.8 m from the left, and as
// much from below.
TEST(PlanFigure, XIsToTheRightAndYUp) {
  ComparedPlan plan;
  plan.truths = {shape_at(0.5, 9.5, ComparedFate::kMissed),
                 shape_at(9.5, 0.5, ComparedFate::kApart)};
  const ColorImage image = draw_compared_plan(plan, "").value();
  const double px_per_m = 1200.0 / 10.8;
  const auto u = static_cast<int>(std::lround(40.0 + 0.9 * px_per_m));
  const auto v = static_cast<int>(std::lround(64.0 + 0.9 * px_per_m));
  EXPECT_EQ(image.at(u, v), kMissedRed);
  EXPECT_EQ(image.width_px(), 1280);
  EXPECT_NEAR(image.height_px(), 64 + 1200 + 92, 1);
}

TEST(PlanFigure, NothingOneAndManyAreDrawn) {
  EXPECT_TRUE(draw_compared_plan({}, "nothing"));
  const ComparedPlan one{.truths = {shape_at(-7, 1e5, ComparedFate::kMissed)}, .objects = {}};
  EXPECT_GT(count(draw_compared_plan(one, "one").value(), kMissedRed), 50);
  ComparedPlan row;
  for (int i = 0; i < 300; ++i) row.objects.push_back(shape_at(3.0 * i, 0, ComparedFate::kFalse));
  EXPECT_TRUE(draw_compared_plan(row, "a row"));
}

}  // namespace
}  // namespace hypermap
