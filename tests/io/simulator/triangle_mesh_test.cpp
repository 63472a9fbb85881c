// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

using Eigen::Vector3d;

TEST(TriangleMesh, ABoxHasTwelveTrianglesAndItsOwnBounds) {
  const TriangleMesh mesh = MeshBuilder().box({-1, 0, 2}, {1, 3, 2.5}).build();
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_EQ(mesh.parts.size(), 1U);
  EXPECT_EQ(bounds(mesh).min_in_map, Vector3d(-1, 0, 2));
  EXPECT_EQ(bounds(mesh).max_in_map, Vector3d(1, 3, 2.5));
}

TEST(TriangleMesh, AFrustumHasTheLateralAreaOfItsPolygon) {
  // A prism over a regular 20-gon of radius 1, height 2: lateral area 2 * 20 * 2 sin(pi/20).
  const TriangleMesh mesh = MeshBuilder().frustum({0, 0, 0}, {0, 0, 2}, 1.0, 1.0, false).build();
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f u = mesh.vertices[b] - mesh.vertices[a];
    const Eigen::Vector3f v = mesh.vertices[c] - mesh.vertices[a];
    area += 0.5 * static_cast<double>(u.cross(v).norm());
  }
  EXPECT_NEAR(area, 2.0 * 20.0 * 2.0 * std::sin(std::numbers::pi / 20.0), 1e-5);
}

TEST(TriangleMesh, AnUpperHalfEllipsoidStandsOnItsCentre) {
  const Box box = bounds(MeshBuilder().ellipsoid({1, 2, 3}, {0.5, 0.25, 0.1}, true).build());
  EXPECT_TRUE(box.min_in_map.isApprox(Vector3d(0.5, 1.75, 3.0), 1e-6));
  EXPECT_TRUE(box.max_in_map.isApprox(Vector3d(1.5, 2.25, 3.1), 1e-6));
}

TEST(TriangleMesh, MaterialsAreListedOnceAndFollowTheirSolids) {
  const SurfaceMaterial red{{200, 0, 0}, SurfacePattern::kPlain};
  const SurfaceMaterial wood{{90, 60, 30}, SurfacePattern::kWood};
  const TriangleMesh mesh = MeshBuilder()
                                .material(red)
                                .box({0, 0, 0}, {1, 1, 1})
                                .material(wood)
                                .box({2, 0, 0}, {3, 1, 1})
                                .material(red)
                                .box({4, 0, 0}, {5, 1, 1})
                                .build();
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[mesh.material_of_triangle[0]], red);
  EXPECT_EQ(mesh.materials[mesh.material_of_triangle[12]], wood);
  EXPECT_EQ(mesh.materials[mesh.material_of_triangle[24]], red);
}

TEST(TriangleMesh, MovingAMeshMovesItsBounds) {
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(10, 0, 1) * Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ());
  const Box box = bounds(transformed(MeshBuilder().box({0, 0, 0}, {2, 1, 1}).build(), motion));
  EXPECT_TRUE(box.min_in_map.isApprox(Vector3d(9, 0, 1), 1e-6));  // x' = 10 - y, y' = x
  EXPECT_TRUE(box.max_in_map.isApprox(Vector3d(10, 2, 2), 1e-6));
}

TEST(TriangleMesh, TheFootprintOfOverlappingBoxesIsTheirUnion) {
  // An L: 2 x 1 and 1 x 2 that share a square of 1: area 2 + 2 - 1 = 3, six corners.
  const auto outline =
      footprint(MeshBuilder().box({0, 0, 0}, {2, 1, 1}).box({0, 0, 0.5}, {1, 2, 2}).build());
  ASSERT_TRUE(outline) << to_string(outline.error());
  EXPECT_NEAR(area_m2(*outline), 3.0, 1e-9);
  EXPECT_EQ(outline->outer.size(), 6U);
  EXPECT_FALSE(contains(*outline, {1.5, 1.5}));
}

TEST(TriangleMesh, TheFootprintHasNoHolesThatItEncloses) {
  const auto frame = footprint(MeshBuilder()
                                   .box({0, 0, 0}, {3, 0.1, 1})
                                   .box({0, 2.9, 0}, {3, 3, 1})
                                   .box({0, 0, 0}, {0.1, 3, 1})
                                   .box({2.9, 0, 0}, {3, 3, 1})
                                   .build());
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->holes.empty());
  EXPECT_NEAR(area_m2(*frame), 9.0, 1e-9);
}

TEST(TriangleMesh, AFootprintInPiecesIsTheHullOfAll) {
  const auto legs =
      footprint(MeshBuilder().box({0, 0, 0}, {1, 1, 1}).box({3, 0, 0}, {4, 1, 1}).build());
  ASSERT_TRUE(legs);
  EXPECT_NEAR(area_m2(*legs), 4.0, 1e-9);
}

TEST(TriangleMesh, AnUprightSheetCoversNoArea) {
  const auto nothing =
      footprint(MeshBuilder()
                    .sheet(std::array{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 1)})
                    .build());
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
