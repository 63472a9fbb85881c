// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hypermap {
namespace {

constexpr ImageRect kCanvas{0, 0, 640, 480};

/// Anchors all over the canvas, or all in a small part of it.
std::vector<LabelRequest> random_requests(std::size_t count, double spread_px, unsigned seed) {
  std::mt19937 random(seed);
  const auto up_to = [&](double limit) {
    return limit * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<LabelRequest> requests;
  for (std::size_t i = 0; i < count; ++i) {
    requests.push_back(
        {200 + up_to(spread_px), 200 + up_to(spread_px), 20 + up_to(80), 12 + up_to(8)});
  }
  return requests;
}

TEST(LabelLayout, ALoneLabelStandsCentredOverItsAnchor) {
  const std::vector<LabelRequest> requests{{100, 200, 60, 20}};
  const auto placed = place_labels(requests, kCanvas, {}, {.gap_px = 3});
  ASSERT_TRUE(placed.at(0).shown);
  EXPECT_EQ(placed[0].rect, (ImageRect{70, 177, 60, 20}));  // x 100 - 60/2, y 200 - 3 - 20
  EXPECT_FALSE(placed[0].leader);
}

TEST(LabelLayout, NoTwoLabelsOverlapAndNoneLeavesTheCanvas) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto requests = random_requests(40, seed < 10 ? 240.0 : 60.0, seed);
    const auto placed = place_labels(requests, kCanvas, {});
    ASSERT_EQ(placed.size(), requests.size());
    for (std::size_t a = 0; a < placed.size(); ++a) {
      if (!placed[a].shown) continue;
      const ImageRect& rect = placed[a].rect;
      EXPECT_TRUE(rect.x_px >= 0 && rect.y_px >= 0 && rect.x_px + rect.width_px <= 640 &&
                  rect.y_px + rect.height_px <= 480);
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_FALSE(placed[b].shown && overlap(rect, placed[b].rect)) << seed;
      }
    }
  }
}

TEST(LabelLayout, ScatteredLabelsAllFindAPlace) {
  const auto placed = place_labels(random_requests(25, 240.0, 7), kCanvas, {});
  EXPECT_TRUE(std::all_of(placed.begin(), placed.end(), [](const auto& one) { return one.shown; }));
}

TEST(LabelLayout, LabelsKeepOffObstacles) {
  const std::vector<ImageRect> obstacles{{0, 0, 640, 180}, {300, 180, 340, 300}};
  for (const PlacedLabel& label : place_labels(random_requests(30, 240.0, 3), kCanvas, obstacles)) {
    if (!label.shown) continue;
    for (const ImageRect& obstacle : obstacles) EXPECT_FALSE(overlap(label.rect, obstacle));
  }
}

// Objects of 30 x 20 px: labels stand beside their own and all others.
TEST(LabelLayout, LabelsStandBesideSmallObjects) {
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 4; ++i) {
    const double x = 200.0 + 40.0 * i;
    requests.push_back({x + 15.0, 200.0, 60, 20, ImageRect{x, 200.0, 30.0, 20.0}});
  }
  for (const PlacedLabel& label : place_labels(requests, kCanvas, {})) {
    ASSERT_TRUE(label.shown);
    for (const LabelRequest& request : requests)
      EXPECT_FALSE(overlap(label.rect, request.subject)) << request.anchor_x_px;
  }
}

// The second subject covers all places within reach; the first label's own is never covered.
TEST(LabelLayout, AnotherObjectIsCoveredRatherThanALabelLost) {
  const std::vector<LabelRequest> requests{{100, 100, 40, 20, ImageRect{90, 100, 20, 10}},
                                           {400, 400, 40, 20, ImageRect{0, 0, 640, 480}}};
  const auto placed = place_labels(requests, kCanvas, {});
  ASSERT_TRUE(placed.at(0).shown);
  EXPECT_FALSE(overlap(placed[0].rect, requests[0].subject));
  EXPECT_FALSE(placed.at(1).shown);
}

TEST(LabelLayout, ADisplacedLabelHasALeader) {
  const std::vector<LabelRequest> requests{{300, 200, 100, 20}, {300, 200, 100, 20}};
  const std::vector<ImageRect> obstacles{{240, 130, 120, 110}};
  const auto placed = place_labels(requests, kCanvas, obstacles);
  ASSERT_TRUE(placed.at(0).shown);
  EXPECT_TRUE(placed[0].leader);
}

TEST(LabelLayout, WhatIsSeenOutsideTheCanvasHasNoLabel) {
  const std::vector<LabelRequest> requests{{-5, 200, 60, 20}, {100, 490, 60, 20}};
  for (const PlacedLabel& label : place_labels(requests, kCanvas, {})) EXPECT_FALSE(label.shown);
}

TEST(LabelLayout, WhatFindsNoPlaceIsNotShown) {
  const std::vector<LabelRequest> requests{{100, 100, 60, 20}};
  const std::vector<ImageRect> all{kCanvas};
  EXPECT_FALSE(place_labels(requests, kCanvas, all).at(0).shown);
  EXPECT_TRUE(place_labels({}, kCanvas, {}).empty());
}

TEST(LabelLayout, RectanglesThatShareAnEdgeDoNotOverlap) {
  EXPECT_FALSE(overlap({0, 0, 10, 10}, {10, 0, 10, 10}));
  EXPECT_TRUE(overlap({0, 0, 10, 10}, {9.5, 9.5, 10, 10}));
}

}  // namespace
}  // namespace hypermap
