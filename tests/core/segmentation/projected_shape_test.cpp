// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/projected_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The upper half of a box of 0.4 x 0.2 m, as a camera sees it, 1 cm apart.
std::vector<Eigen::Vector3f> box_surface() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 40; ++i) {
    for (int k = 0; k <= 20; ++k) {
      const auto x = 1.0F + 0.01F * static_cast<float>(i);
      points.emplace_back(x, 2.0F, 0.01F * static_cast<float>(k));
      points.emplace_back(x, 2.0F + 0.01F * static_cast<float>(k), 0.2F);
    }
  }
  return points;
}

// [hypermap] 3.4.4: projected to the floor, the hull of the box is its footprint, 0.08 m2.
TEST(ProjectedHull, IsTheFootprintOfTheSurface) {
  const Polygon hull = projected_hull(box_surface(), 0.0).value();
  EXPECT_NEAR(area_m2(hull), 0.08, 1e-6);
  EXPECT_TRUE(centroid(hull).isApprox(Eigen::Vector2d(1.2, 2.1), 1e-5));
}

TEST(ProjectedHull, OfThinnedPointsIsSmallerByTheCellsAtItsEdges) {
  const double area = area_m2(projected_hull(box_surface(), 0.05).value());
  EXPECT_LT(area, 0.08);
  EXPECT_GT(area, 0.35 * 0.15);  // each side loses less than half a cell
}

/// Points without order, half of them left of and below the origin.
std::vector<Eigen::Vector3f> scattered(std::size_t count, double extent_m) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> along(static_cast<float>(-0.5 * extent_m),
                                              static_cast<float>(0.5 * extent_m));
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(along(random), along(random), along(random));
  return points;
}

/// The hull of the mean of each cell's points, on millimetres.
Polygon hull_by_cells(const std::vector<Eigen::Vector3f>& points, double leaf_size_m) {
  std::map<std::pair<double, double>, std::vector<Eigen::Vector2d>> cells;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2d at = point.head<2>().cast<double>();
    cells[{std::floor(at.x() / leaf_size_m), std::floor(at.y() / leaf_size_m)}].push_back(at);
  }
  std::vector<Eigen::Vector2d> means;
  for (const auto& [cell, members] : cells) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& at : members) sum += at;
    const Eigen::Vector2d mean = sum / static_cast<double>(members.size());
    means.emplace_back(1e3 * mean);
    means.back() = means.back().array().round() / 1e3;
  }
  return convex_hull(means).value();
}

// Cells of 0.25 m: their edges are exact in binary.
TEST(ProjectedHull, IsThatOfTheMeansOfCellsOfPointsThatLieClose) {
  const auto points = scattered(2'000, 3.0);
  EXPECT_EQ(projected_hull(points, 0.25).value(), hull_by_cells(points, 0.25));
}

TEST(ProjectedHull, IsTheSameOfPointsThatLieFarApart) {
  const auto points = scattered(40, 3'000.0);
  EXPECT_EQ(projected_hull(points, 0.25).value(), hull_by_cells(points, 0.25));
}

TEST(ProjectedHull, RefusesPointsThatSpanNoArea) {
  const std::vector<Eigen::Vector3f> upright{{1, 1, 0}, {1, 1, 1}, {1, 1, 2}};
  EXPECT_EQ(projected_hull(upright, 0.0).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(projected_hull({}, 0.0).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(projected_hull(box_surface(), -0.1).error().field, "leaf_size_m");
}

}  // namespace
}  // namespace hypermap
