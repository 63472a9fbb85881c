// SPDX-License-Identifier: BSD-3-Clause
#include "area_alignment.hpp"

#include "made_rooms.hpp"

#include <gtest/gtest.h>

namespace hypermap::test {
namespace {

GridGeometry cells_of_room() {
  return {.resolution_m = 0.05, .origin = Eigen::Vector2d(-0.5, -0.5), .cols = 200, .rows = 180};
}

/// From cells to cells.
Eigen::Matrix3d in_cells(const Eigen::Matrix3d& room_from_frame, const GridGeometry& moving) {
  return frame_from_cells(cells_of_room()).inverse() * room_from_frame * frame_from_cells(moving);
}

TEST(AreaAlignment, AGridAgreesWithItself) {
  const GridImage room =
      image_of(seen_room(furnished_room(2), cells_of_room(), Eigen::Matrix3d::Identity()));
  const AreaAgreement same = agreement_of(room, room, Eigen::Matrix3d::Identity());
  EXPECT_NEAR(same.agreement, 1.0, 1e-9);
  EXPECT_NEAR(same.overlap, 1.0, 1e-9);
  EXPECT_NEAR(same.explained(), 1.0, 1e-9);
  const AreaAgreement beside = agreement_of(room, room, plane_pose(8.0, 5.0, 0.0));
  EXPECT_LT(beside.agreement, 0.6);
  EXPECT_LT(beside.overlap, 1.0);
  EXPECT_EQ(agreement_of(room, room, plane_pose(500.0, 0.0, 0.0)).overlap, 0.0);
}

TEST(AreaAlignment, WhatSaysTheSameEverywhereAgreesWithNothing) {
  const GridImage flat{Plane::Constant(20, 20, 0.5F), Plane::Ones(20, 20)};
  EXPECT_EQ(agreement_of(flat, flat, Eigen::Matrix3d::Identity()).agreement, 0.0);
}

TEST(AreaAlignment, ThreeCellsAndThreeDegreesAreMended) {
  const PlanRoom room = furnished_room(9);
  const GridGeometry view{
      .resolution_m = 0.05, .origin = Eigen::Vector2d(-2.0, -2.0), .cols = 80, .rows = 80};
  const Eigen::Matrix3d truth = plane_pose(room.size.x() / 2.0, room.size.y() / 2.0, 0.37);
  const GridImage moving = image_of(seen_room(room, view, truth));
  const GridImage fixed = image_of(seen_room(room, cells_of_room(), Eigen::Matrix3d::Identity()));
  const Eigen::Matrix3d wanted = in_cells(truth, view);
  const Eigen::Matrix3d start = plane_pose(2.3, -2.2, 0.0) * wanted * plane_pose(0.0, 0.0, 0.02);
  const Eigen::Matrix3d found = aligned_by_area(moving, fixed, start, RegistrationKind::kRigid);
  const GridGeometry cells{.resolution_m = 1.0, .cols = 80, .rows = 80};
  EXPECT_GT(most_apart(start, wanted, cells), 3.0);
  EXPECT_LT(most_apart(found, wanted, cells), 0.1);
  // Rigid it started, rigid it stays.
  EXPECT_NEAR(found(0, 0), found(1, 1), 1e-9);
  EXPECT_NEAR(found(0, 0) * found(0, 0) + found(1, 0) * found(1, 0), 1.0, 1e-9);
}

TEST(AreaAlignment, WhatIsLessSureIsPlacedAsWell) {
  const GridGeometry view{
      .resolution_m = 0.05, .origin = Eigen::Vector2d(-2.0, -2.0), .cols = 80, .rows = 80};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const PlanRoom room = furnished_room(seed);
    const GridImage fixed = image_of(seen_room(room, cells_of_room(), plane_pose(0.0, 0.0, 0.0)));
    const Eigen::Matrix3d truth = plane_pose(room.size.x() / 2.0, room.size.y() / 2.0, 0.37);
    GridImage moving = image_of(seen_room(room, view, truth));
    moving.value = moving.known * (0.15F * moving.value - 0.1F);
    const Eigen::Matrix3d wanted = in_cells(truth, view);
    const Eigen::Matrix3d start = plane_pose(1.3, -1.2, 0.0) * wanted;
    const Eigen::Matrix3d found = aligned_by_area(moving, fixed, start, RegistrationKind::kRigid);
    EXPECT_LT(most_apart(found, wanted, {.resolution_m = 1.0, .cols = 80, .rows = 80}), 0.2)
        << seed;
  }
}

TEST(AreaAlignment, WithoutCommonCellsTheStartStays) {
  const GridImage flat{Plane::Constant(20, 20, 0.5F), Plane::Ones(20, 20)};
  const Eigen::Matrix3d start = plane_pose(100.0, 0.0, 0.0);
  EXPECT_TRUE(aligned_by_area(flat, flat, start, RegistrationKind::kRigid).isApprox(start, 1e-12));
}

}  // namespace
}  // namespace hypermap::test
