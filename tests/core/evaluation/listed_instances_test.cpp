// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/listed_instances.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hypermap {
namespace {

constexpr double kQuarterTurnRad = std::numbers::pi / 2.0;

TEST(ListedInstances, YawTurnsTheWidthAboutUp) {
  const ListedInstance instance{.name = "table",
                                .centre = {{1.0, 2.0, 0.5}},
                                .size_m = {2.0, 1.0, 0.8},
                                .yaw_rad = kQuarterTurnRad};
  const Box box = box_in_map(instance, Eigen::Vector3d::UnitZ(), {});
  EXPECT_TRUE(box.min_in_map.isApprox(Eigen::Vector3d(0.5, 1.0, 0.1)));
  EXPECT_TRUE(box.max_in_map.isApprox(Eigen::Vector3d(1.5, 3.0, 0.9)));
}

TEST(ListedInstances, ABoxAtAnAngleIsTheSmallestAroundItsCorners) {
  // A square of 1 m turned by 45 degrees is sqrt(2) wide each way.
  const ListedInstance instance{
      .name = "square", .size_m = {1.0, 1.0, 0.2}, .yaw_rad = std::numbers::pi / 4.0};
  const Eigen::Vector3d extent = box_in_map(instance, Eigen::Vector3d::UnitZ(), {}).extent();
  EXPECT_TRUE(extent.isApprox(Eigen::Vector3d(std::numbers::sqrt2, std::numbers::sqrt2, 0.2)));
}

TEST(ListedInstances, HeightGoesAlongUpWhateverAxisThatIs) {
  // World of a camera: x right, y down, z forward. The map has x right, y forward, z up.
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const ListedInstance instance{
      .name = "chair", .centre = {{0.0, 0.6, 2.0}}, .size_m = {0.5, 0.6, 0.8}};
  const Box box = box_in_map(instance, -Eigen::Vector3d::UnitY(), MapFromInput(turn));
  EXPECT_TRUE(box.centre().isApprox(Eigen::Vector3d(0.0, 2.0, -0.6)));
  EXPECT_TRUE(box.extent().isApprox(Eigen::Vector3d(0.5, 0.6, 0.8)));
}

TEST(ListedInstances, WhereXIsSteepYawCountsFromY) {
  const ListedInstance instance{.name = "shelf", .size_m = {2.0, 0.4, 1.0}};
  const InputFromInstance placed = input_from_instance(instance, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(placed.isometry().linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(placed.isometry().linear().col(2).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(is_rigid(placed.isometry(), 1e-12));
}

}  // namespace
}  // namespace hypermap
