// SPDX-License-Identifier: BSD-3-Clause
#include "rival_search.hpp"

#include "area_alignment.hpp"
#include "made_rooms.hpp"

#include <gtest/gtest.h>

namespace hypermap::test {
namespace {

const PlacementFilter kAnywhere = [](const Eigen::Matrix3d&) { return true; };

/// Random cells, all known, and a square of them repeated `period` cells on when that is not 0.
GridImage speckles(int cols, int rows, int period) {
  GridImage image{Plane::Zero(rows, cols), Plane::Ones(rows, cols)};
  const CounterRng random(3, 3);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const int source = period > 0 ? col % period : col;
      const auto number = std::uint64_t{1000} * static_cast<std::uint64_t>(row) +
                          static_cast<std::uint64_t>(source);
      image.value(row, col) = static_cast<float>(random.uniform_at(number) - 0.5);
    }
  }
  return image;
}

GridImage part_of(const GridImage& image, int col, int row, int cols, int rows) {
  return {image.value.block(row, col, rows, cols), image.known.block(row, col, rows, cols)};
}

TEST(RivalSearch, WhatIsLikeNothingElseHasNoRival) {
  const GridImage fixed = speckles(90, 60, 0);
  const GridImage moving = part_of(fixed, 20, 10, 40, 30);
  EXPECT_LT(best_rival_share(moving, fixed, plane_pose(20.0, 10.0, 0.0), kAnywhere), 0.4);
}

TEST(RivalSearch, APeriodIsARivalWhereItIsAllowed) {
  const GridImage fixed = speckles(90, 60, 16);
  const GridImage moving = part_of(fixed, 20, 10, 40, 30);
  EXPECT_GT(best_rival_share(moving, fixed, plane_pose(20.0, 10.0, 0.0), kAnywhere), 0.95);
  const PlacementFilter near = [](const Eigen::Matrix3d& placement) {
    return std::abs(placement(0, 2) - 20.0) < 14.0;
  };
  EXPECT_LT(best_rival_share(moving, fixed, plane_pose(20.0, 10.0, 0.0), near), 0.6);
}

TEST(RivalSearch, AHalfTurnIsARival) {
  GridImage fixed = speckles(41, 31, 0);
  fixed.value = (fixed.value + fixed.value.reverse()).eval();
  EXPECT_GT(best_rival_share(fixed, fixed, plane_pose(0.0, 0.0, 0.0), kAnywhere), 0.95);
  const PlacementFilter unturned = [](const Eigen::Matrix3d& placement) {
    return placement(0, 0) > 0.5;
  };
  EXPECT_LT(best_rival_share(fixed, fixed, plane_pose(0.0, 0.0, 0.0), unturned), 0.5);
}

TEST(RivalSearch, CoarseImagesFindTheSame) {
  // 700 cells are compared at a quarter of their resolution; squares of 8 cells are still there.
  const GridImage small = speckles(88, 60, 22);
  GridImage fixed{Plane::Zero(480, 704), Plane::Ones(480, 704)};
  for (int row = 0; row < 480; ++row) {
    for (int col = 0; col < 704; ++col) fixed.value(row, col) = small.value(row / 8, col / 8);
  }
  const GridImage moving = part_of(fixed, 160, 80, 320, 240);
  EXPECT_GT(best_rival_share(moving, fixed, plane_pose(160.0, 80.0, 0.0), kAnywhere), 0.95);
}

TEST(RivalSearch, WithoutAnyAgreementAllIsARival) {
  const GridImage flat{Plane::Constant(20, 20, 0.5F), Plane::Ones(20, 20)};
  EXPECT_EQ(best_rival_share(flat, flat, plane_pose(0.0, 0.0, 0.0), kAnywhere), 1.0);
}

}  // namespace
}  // namespace hypermap::test
