// SPDX-License-Identifier: BSD-3-Clause
#include "grid_image.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hypermap::test {
namespace {

TEST(GridImage, CellsAreProbabilitiesFromMinusOneToOne) {
  LogOddsGrid grid = LogOddsGrid::create({.resolution_m = 0.1, .cols = 3, .rows = 2}).value();
  grid.set({1, 0}, 847);   // p = 0.7
  grid.set({2, 1}, -405);  // p = 0.4
  const GridImage image = image_of(grid);
  EXPECT_NEAR(image.value(0, 1), 0.4F, 1e-3F);
  EXPECT_NEAR(image.value(1, 2), -0.2F, 1e-3F);
  EXPECT_EQ(image.known.sum(), 2.0F);
  EXPECT_EQ(middle_of_known(image), Eigen::Vector2d(1.5, 0.5));
}

TEST(GridImage, SmoothingTakesKnownCellsAlone) {
  GridImage image{Plane::Zero(9, 9), Plane::Zero(9, 9)};
  image.value.leftCols(5) = 0.5F;
  image.known.leftCols(5) = 1.0F;
  const GridImage soft = smoothed(image, 1.5);
  for (int col = 0; col < 5; ++col) EXPECT_NEAR(soft.value(4, col), 0.5F, 1e-5F);
  for (int col = 5; col < 9; ++col) EXPECT_EQ(soft.value(4, col), 0.0F);
}

TEST(GridImage, BlurringKeepsTheSumAndTheMiddle) {
  Plane plane = Plane::Zero(21, 21);
  plane(10, 10) = 1.0F;
  const Plane soft = blurred(plane, 1.2);
  EXPECT_NEAR(soft.sum(), 1.0F, 1e-5F);
  EXPECT_NEAR(soft(10, 8), soft(12, 10), 1e-7F);
  EXPECT_NEAR(soft(10, 8) / soft(10, 10), std::exp(-0.5F * 4.0F / 1.44F), 1e-5F);
}

TEST(GridImage, SamplesAreBilinearWithTheirSlopes) {
  Plane plane(2, 2);
  plane << 0.0F, 1.0F,  //
      2.0F, 5.0F;
  const PlaneSample sample = sampled(plane, {0.25, 0.5});
  EXPECT_DOUBLE_EQ(sample.value, 0.5 * 0.25 + 0.5 * (0.75 * 2.0 + 0.25 * 5.0));
  EXPECT_DOUBLE_EQ(sample.slope.x(), 0.5 * 1.0 + 0.5 * 3.0);
  EXPECT_DOUBLE_EQ(sample.slope.y(), 0.75 * 2.0 + 0.25 * 4.0);
  EXPECT_FALSE(is_inside(plane, {1.0, 0.0}));
  EXPECT_FALSE(is_inside(plane, {-0.1, 0.0}));
}

TEST(GridImage, WholeNumbersAreCentresOfCells) {
  const GridGeometry geometry{.resolution_m = 0.5,
                              .origin = Eigen::Vector2d(1.0, 2.0),
                              .yaw_rad = std::numbers::pi / 2.0,
                              .cols = 4,
                              .rows = 3};
  const Eigen::Matrix3d frame = frame_from_cells(geometry);
  EXPECT_TRUE(moved(frame, {2.0, 1.0}).isApprox(centre(geometry, {2, 1}), 1e-12));
  EXPECT_TRUE(moved(frame, {0.0, 0.0}).isApprox(Eigen::Vector2d(0.75, 2.25), 1e-12));
}

}  // namespace
}  // namespace hypermap::test
