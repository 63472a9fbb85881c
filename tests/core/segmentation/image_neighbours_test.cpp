// SPDX-License-Identifier: BSD-3-Clause
// Nearest neighbours in an image against a look at all points.
#include "segmentation/policies/image_neighbours.hpp"

#include "core/segmentation/office_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace hypermap {
namespace {

float square_between(const PixelCloud& cloud, std::uint32_t a, std::uint32_t b) {
  return (cloud.points_in_camera[a] - cloud.points_in_camera[b]).squaredNorm();
}

/// Square distances of the nearest points, ascending.
std::vector<float> nearest_squares(const PixelCloud& cloud,
                                   std::uint32_t point,
                                   std::size_t count) {
  std::vector<float> squares(cloud.pixels.size());
  for (std::uint32_t i = 0; i < squares.size(); ++i) squares[i] = square_between(cloud, point, i);
  std::ranges::sort(squares);
  squares.resize(std::min(count, squares.size()));
  return squares;
}

/// Asks every `step`-th point for as many neighbours as `counts` says in turn, of which ever other
/// ones shall come first: what one call leaves behind must not tell in the next.
void expect_nearest(const PixelCloud& cloud,
                    const PinholeCamera& camera,
                    const std::vector<std::size_t>& counts,
                    std::uint32_t step) {
  ImageNeighbours neighbours(cloud, camera);
  std::size_t turn = 0;
  for (std::uint32_t point = 0; point < cloud.pixels.size(); point += step) {
    const std::size_t count = counts[turn++ % counts.size()];
    const std::size_t num_first = 1 + turn * 7 % count;
    const auto found = neighbours.nearest(point, count, num_first);
    std::vector<std::uint32_t> unique(found.begin(), found.end());
    std::ranges::sort(unique);
    ASSERT_EQ(std::ranges::adjacent_find(unique), unique.end()) << point;
    std::vector<float> squares;
    squares.reserve(found.size());
    for (const std::uint32_t i : found) squares.push_back(square_between(cloud, point, i));
    const std::span first = std::span(squares).first(std::min(num_first, squares.size()));
    std::ranges::sort(first);
    std::ranges::sort(std::span(squares).subspan(first.size()));
    const std::vector<float> expected = nearest_squares(cloud, point, count);
    ASSERT_EQ(squares.size(), expected.size()) << point;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      ASSERT_NEAR(squares[i], expected[i], 1e-5F * expected[i] + 1e-12F) << point << ", " << i;
    }
  }
}

PixelCloud cloud_in(const RgbdFrame& frame, const PixelBox& box) {
  Detection detection;
  detection.box_px = box;
  return crop(frame, detection);
}

// Edges, surfaces across the view, the floor at a grazing angle.
TEST(ImageNeighbours, AreThoseOfAllPointsInARoom) {
  const SceneView view = test::office().view(test::look_at({0.3, 0.9, 1.4}, {2.0, 0.1, 0.7}), 3);
  const PixelCloud cloud = cloud_in(view.frame, {150, 120, 470, 420});
  ASSERT_GT(cloud.pixels.size(), 90000U);
  expect_nearest(cloud, view.frame.camera, {50, 30}, 1009);
}

// A hole of the width of many windows, and single pixels in it.
TEST(ImageNeighbours, AreFoundAcrossHoles) {
  SceneView view = test::office().view(test::look_at({0.3, 0.9, 1.4}, {2.0, 0.1, 0.7}), 4);
  for (int v = 180; v < 260; ++v) {
    for (int u = 250; u < 350; ++u) {
      if (u % 31 != 0 || v % 17 != 0) view.frame.depth_m.at(u, v) = 0.0F;
    }
  }
  const PixelCloud cloud = cloud_in(view.frame, {230, 170, 370, 270});
  expect_nearest(cloud, view.frame.camera, {1, 3, 50, 400}, 97);
}

// No window holds the neighbours where each pixel has a depth of its own.
TEST(ImageNeighbours, AreFoundWhereDepthScatters) {
  RgbdFrame frame;
  frame.camera = test::half_kinect_camera();
  frame.depth_m = DepthImage(frame.camera.width_px, frame.camera.height_px);
  std::mt19937 engine(11);
  std::uniform_real_distribution<float> depth_m(0.3F, 9.0F);
  for (float& depth : frame.depth_m.pixels()) depth = depth_m(engine);
  expect_nearest(cloud_in(frame, {40, 30, 200, 150}), frame.camera, {50, 30, 5}, 311);
}

TEST(ImageNeighbours, AreAllPointsWhenThereAreNoMore) {
  const SceneView view = test::office_view(5);
  const PixelCloud cloud = cloud_in(view.frame, {300, 200, 305, 203});
  ASSERT_EQ(cloud.pixels.size(), 15U);
  expect_nearest(cloud, view.frame.camera, {15, 16, 10000, 1}, 1);
}

// So near that squares of distances are no numbers to divide by.
TEST(ImageNeighbours, OfPointsWithoutDistanceAreAnyOfThem) {
  RgbdFrame frame;
  frame.camera = test::half_kinect_camera();
  frame.depth_m = DepthImage(frame.camera.width_px, frame.camera.height_px);
  for (float& depth : frame.depth_m.pixels()) depth = 1e-30F;
  const PixelCloud cloud = cloud_in(frame, {40, 30, 60, 50});
  ImageNeighbours neighbours(cloud, frame.camera);
  EXPECT_EQ(neighbours.nearest(200, 7, 3).size(), 7U);
}

}  // namespace
}  // namespace hypermap
