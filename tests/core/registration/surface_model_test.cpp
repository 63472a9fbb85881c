// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/surface_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

/// Points 2 cm apart on the plane z = height_m over [0, side_m] x [0, side_m].
std::vector<OrientedPoint> floor_points(double height_m, double side_m, double from_x_m = 0.0) {
  std::vector<OrientedPoint> points;
  const int num = static_cast<int>(side_m / 0.02);
  for (int i = 0; i < num; ++i) {
    for (int j = 0; j < num; ++j) {
      points.push_back({{from_x_m + 0.01 + 0.02 * i, 0.01 + 0.02 * j, height_m}});
    }
  }
  return points;
}

TEST(SurfaceGrid, APlaneIsFoundFromEitherSide) {
  SurfaceGrid model(0.1, 4096);
  model.add(floor_points(0.33, 1.0));
  for (const double beside_m : {-0.03, 0.0, 0.03}) {
    const auto plane = model.plane_at({{0.5, 0.5, 0.33 + beside_m}}, 0.02);
    ASSERT_TRUE(plane) << beside_m;
    EXPECT_NEAR(std::abs(plane->normal.z()), 1.0, 1e-9);
    EXPECT_NEAR(plane->point_m.z(), 0.33, 1e-9);
    EXPECT_NEAR(plane->stddev_m, 0.0, 1e-6);
  }
}

TEST(SurfaceGrid, NoiseAcrossTheBorderOfCellsIsOnePlane) {
  // Half of the points lie 1 cm above z = 0.2, half below: in cells of their own. The plane goes
  // through the middle wherever it is looked up; its thickness is 1 cm.
  SurfaceGrid model(0.1, 4096);
  model.add(floor_points(0.19, 1.0));
  model.add(floor_points(0.21, 1.0));
  for (const double beside_m : {-0.02, 0.02}) {
    const auto plane = model.plane_at({{0.5, 0.5, 0.2 + beside_m}}, 0.02);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->point_m.z(), 0.2, 1e-9);
    EXPECT_NEAR(plane->stddev_m, 0.01, 1e-9);
  }
}

TEST(SurfaceGrid, WhatIsNoPlaneOrUnknownIsNone) {
  SurfaceGrid model(0.1, 4096);
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, 0.3}}, 0.02)) << "empty";
  model.add(floor_points(0.33, 1.0));
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, 0.9}}, 0.02)) << "nothing there";
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, std::numeric_limits<double>::quiet_NaN()}}, 0.02));
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, 1e30}}, 0.02));
  for (int layer = 0; layer < 5; ++layer) model.add(floor_points(0.31 + 0.03 * layer, 1.0));
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, 0.35}}, 0.02)) << "as thick as wide";
}

TEST(SurfaceGrid, BothSidesOfAThinBoardAreTwoPlanes) {
  SurfaceGrid model(0.1, 4096);
  std::vector<OrientedPoint> bottom = floor_points(0.33, 1.0);
  for (OrientedPoint& point : bottom) point.normal = -Eigen::Vector3d::UnitZ();
  model.add(bottom);
  model.add(floor_points(0.36, 1.0));
  const auto below = model.plane_at({{0.5, 0.5, 0.345}, -Eigen::Vector3d::UnitZ()}, 0.02);
  const auto above = model.plane_at({{0.5, 0.5, 0.345}, Eigen::Vector3d::UnitZ()}, 0.02);
  ASSERT_TRUE(below);
  ASSERT_TRUE(above);
  EXPECT_NEAR(below->point_m.z(), 0.33, 1e-9);
  EXPECT_NEAR(above->point_m.z(), 0.36, 1e-9);
}

TEST(SurfaceGrid, PointsThatAreNoneAreLeftOut) {
  SurfaceGrid model(0.1, 4096);
  model.add(std::vector<OrientedPoint>{
      {{std::nan(""), 0, 0}}, {{1e9, 0, 0}}, {{0, -std::numeric_limits<double>::infinity(), 0}}});
  EXPECT_EQ(model.num_cells(), 0U);
}

TEST(SurfaceGrid, WhatWasSeenLeastRecentlyGoesFirst) {
  SurfaceGrid model(0.1, 220);
  model.add(floor_points(0.05, 1.0));        // 100 cells
  model.add(floor_points(0.05, 1.0, 10.0));  // 100 more
  EXPECT_EQ(model.num_cells(), 200U);
  model.add(floor_points(0.05, 1.0, 20.0));
  EXPECT_LE(model.num_cells(), 220U);
  EXPECT_FALSE(model.plane_at({{0.5, 0.5, 0.05}}, 0.02));
  EXPECT_TRUE(model.plane_at({{20.5, 0.5, 0.05}}, 0.02));
}

TEST(SurfaceGrid, ACellFollowsASurfaceThatMoved) {
  SurfaceGrid model(0.1, 4096);
  for (int i = 0; i < 100; ++i) model.add(floor_points(0.34, 1.0));
  for (int i = 0; i < 400; ++i) model.add(floor_points(0.36, 1.0));
  const auto plane = model.plane_at({{0.5, 0.5, 0.35}}, 0.02);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->point_m.z(), 0.36, 1e-3);
}

/// The top of a thing, 8 cm wide, at 0.64 m.
std::vector<OrientedPoint> top_of_a_box() {
  std::vector<OrientedPoint> points;
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      points.push_back({{0.5025 + 0.005 * i, 0.5025 + 0.005 * j, 0.64}});
    }
  }
  return points;
}

TEST(SurfaceModel, TheTopOfAThingBesideALargeSurfaceIsAPlaneOfItsOwn) {
  // 6 cm above a table: large cells hold both, small ones the top alone.
  SurfaceGrid coarse(0.1, 4096);
  SurfaceModel model(0.1, 4096);
  for (const auto& points : {floor_points(0.58, 1.0), top_of_a_box()}) {
    coarse.add(points);
    model.add(points);
  }
  const OrientedPoint top{{0.54, 0.54, 0.64}};
  EXPECT_FALSE(coarse.plane_at(top, 0.01));
  const auto plane = model.plane_at(top, 0.01);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->point_m.z(), 0.64, 1e-9);
}

TEST(SurfaceModel, WhereSmallCellsHaveTooFewPointsLargeOnesSay) {
  // Points 5 cm apart: four in the window of small cells, sixteen in that of large ones.
  std::vector<OrientedPoint> sparse;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) sparse.push_back({{0.025 + 0.05 * i, 0.025 + 0.05 * j, 0.33}});
  }
  SurfaceGrid fine(0.05, 4096);
  SurfaceModel model(0.1, 4096);
  fine.add(sparse);
  model.add(sparse);
  const OrientedPoint place{{0.51, 0.51, 0.33}};
  EXPECT_FALSE(fine.plane_at(place, 0.01));
  ASSERT_TRUE(model.plane_at(place, 0.01));
  model.clear();
  EXPECT_FALSE(model.plane_at(place, 0.01));
}

}  // namespace
}  // namespace hypermap
