// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/true_surfaces.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace hypermap {
namespace {

TrueSurfaces one_triangle() {
  return {.objects = {{.id = ObjectId{1},
                       .class_name = "chair",
                       .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                       .triangles = {{0, 1, 2}},
                       .seen_cells = {{0, 0, -1}, {0, 0, 0}}}}};
}

std::string refused_field(const TrueSurfaces& surfaces) {
  const auto checked = validate(surfaces);
  return checked ? "none" : checked.error().field;
}

TEST(TrueSurfaces, AnythingThatIsNoSurfaceIsRefusedByName) {
  EXPECT_EQ(refused_field(one_triangle()), "none");
  TrueSurfaces surfaces = one_triangle();
  surfaces.seen_cell_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_field(surfaces), "seen_cell_m");
  surfaces = one_triangle();
  surfaces.objects[0].id = kNoObject;
  EXPECT_EQ(refused_field(surfaces), "object 0 id");
  surfaces = one_triangle();
  surfaces.objects.push_back(surfaces.objects[0]);
  EXPECT_EQ(refused_field(surfaces), "object 1 id");
  surfaces = one_triangle();
  surfaces.objects[0].class_name.clear();
  EXPECT_EQ(refused_field(surfaces), "object 1 class");
  surfaces = one_triangle();
  surfaces.objects[0].vertices[2].x() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refused_field(surfaces), "object 1 vertices");
  surfaces.objects[0].vertices[2].x() = 1.1e6F;
  EXPECT_EQ(refused_field(surfaces), "object 1 vertices");
  surfaces = one_triangle();
  surfaces.objects[0].triangles[0][2] = 3;
  EXPECT_EQ(refused_field(surfaces), "object 1 triangles");
  surfaces = one_triangle();
  surfaces.objects[0].seen_cells[1] = surfaces.objects[0].seen_cells[0];
  EXPECT_EQ(refused_field(surfaces), "object 1 seen_cells");
  surfaces = one_triangle();
  surfaces.objects[0].seen_cells[1].x = 19'999'999;  // its centre is 2.5 cm below 1e6 m
  EXPECT_EQ(refused_field(surfaces), "none");
  surfaces.objects[0].seen_cells[1].x = 20'000'000;
  EXPECT_EQ(refused_field(surfaces), "object 1 seen_cells");
}

TEST(TrueSurfaces, CellsLieOnTheLatticeOfTheOrigin) {
  EXPECT_EQ(cell_of({0.0, 0.049, -0.001}, 0.05), (SurfaceCell{0, 0, -1}));
  EXPECT_TRUE(centre_of({0, 1, -1}, 0.05).isApprox(Eigen::Vector3d(0.025, 0.075, -0.025), 1e-12));
  EXPECT_EQ(triangle_at(one_triangle().objects[0], 0)[1], Eigen::Vector3d(1, 0, 0));
}

TEST(TrueSurfaces, AQuarterTurnAndAShiftByCellsMoveCellsOneToOne) {
  // A quarter turn about z takes (x, y) to (-y, x); then 0.1 m along x, two cells of 0.05 m.
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(0.1, 0, 0) *
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  const TrueSurface moved = transformed(one_triangle(), motion).objects[0];
  EXPECT_TRUE(moved.vertices[1].isApprox(Eigen::Vector3f(0.1F, 1, 0), 1e-6F));
  EXPECT_EQ(moved.seen_cells, (std::vector<SurfaceCell>{{1, 0, -1}, {1, 0, 0}}));
}

}  // namespace
}  // namespace hypermap
