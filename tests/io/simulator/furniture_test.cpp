// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/furniture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace hypermap {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TriangleMesh shape(std::string_view name, const Vector3d& size = Vector3d::Zero()) {
  auto mesh = build_furniture({name, size, {}});
  EXPECT_TRUE(mesh) << to_string(mesh.error());
  return mesh ? *std::move(mesh) : TriangleMesh{};
}

double footprint_area(std::string_view name, const Vector3d& size = Vector3d::Zero()) {
  const auto outline = footprint(shape(name, size));
  EXPECT_TRUE(outline) << name;
  return outline ? area_m2(*outline) : 0.0;
}

/// Share of a fine grid over the bounds whose columns meet a triangle: area by brute force.
double rastered_area(const TriangleMesh& mesh) {
  constexpr double kStep = 0.002;
  const Box box = bounds(mesh);
  const auto side = [](const Vector2d& a, const Vector2d& b, const Vector2d& p) {
    return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
  };
  const auto cols = static_cast<std::size_t>(std::ceil(box.extent().x() / kStep));
  const auto rows = static_cast<std::size_t>(std::ceil(box.extent().y() / kStep));
  std::vector<bool> covered(cols * rows, false);
  const Vector2d origin = box.min_in_map.head<2>();
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector2d, 3> t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = (mesh.vertices[triangle[i]].head<2>().cast<double>() - origin) / kStep;
    const Vector2d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
    const Vector2d high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    const auto last_row = std::min(rows, static_cast<std::size_t>(std::ceil(high.y())));
    const auto last_col = std::min(cols, static_cast<std::size_t>(std::ceil(high.x())));
    for (auto row = static_cast<std::size_t>(std::max(0.0, low.y())); row < last_row; ++row) {
      for (auto col = static_cast<std::size_t>(std::max(0.0, low.x())); col < last_col; ++col) {
        const Vector2d p(static_cast<double>(col) + 0.5, static_cast<double>(row) + 0.5);
        const double a = side(t[0], t[1], p);
        const double b = side(t[1], t[2], p);
        const double c = side(t[2], t[0], p);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
          covered[row * cols + col] = true;
      }
    }
  }
  return kStep * kStep * static_cast<double>(std::ranges::count(covered, true));
}

TEST(Furniture, EveryShapeHasExactlyTheSizeAskedForAndStandsOnTheFloor) {
  for (const std::string_view name : furniture_shapes()) {
    const Box box = bounds(shape(name, {0.7, 0.9, 1.1}));
    EXPECT_TRUE(box.extent().isApprox(Vector3d(0.7, 0.9, 1.1), 1e-5)) << name;
    EXPECT_NEAR(box.min_in_map.z(), 0.0, 1e-6) << name;
    EXPECT_NEAR(box.centre().x(), 0.0, 1e-6) << name;
    EXPECT_NEAR(box.centre().y(), 0.0, 1e-6) << name;
  }
}

TEST(Furniture, FootprintsOfBoxyShapesAreTheirRectangles) {
  EXPECT_NEAR(footprint_area("table"), 0.80 * 1.60, 1e-6);
  EXPECT_NEAR(footprint_area("cupboard"), 0.50 * 1.20, 1e-6);
  EXPECT_NEAR(footprint_area("sink"), 0.46 * 0.60, 1e-6);
  EXPECT_NEAR(footprint_area("keyboard"), 0.15 * 0.45, 1e-6);
  EXPECT_NEAR(footprint_area("chair"), 0.50 * 0.46, 1e-6);
  EXPECT_NEAR(footprint_area("bench", {0.6, 1.5, 0.8}), 0.6 * 1.5, 0.06 * 1.5);  // less the back
}

TEST(Furniture, FootprintsOfRoundShapesAreRegularPolygons) {
  // 20-gon of radius r: 10 r^2 sin(2 pi / 20).
  const double polygon = 10.0 * std::sin(2.0 * std::numbers::pi / 20.0);
  EXPECT_NEAR(footprint_area("bin", {0.4, 0.4, 0.5}), 0.2 * 0.2 * polygon, 2e-4);
  // The mouse is half an ellipsoid: the polygon stretched to the two radii.
  EXPECT_NEAR(footprint_area("mouse", {0.12, 0.06, 0.04}), 0.06 * 0.03 * polygon, 2e-5);
}

TEST(Furniture, FootprintsAreWhatTheTrianglesCoverFromAbove) {
  // Plants and umbrellas have sheets; chairs on castors have parts at odd angles. Enclosed holes
  // are filled in the footprint and not in the raster, so it may only be larger, and by little.
  for (const std::string_view name : furniture_shapes()) {
    const TriangleMesh mesh = shape(name);
    const double raster = rastered_area(mesh);
    EXPECT_GT(footprint_area(name), 0.97 * raster - 1e-4) << name;
    EXPECT_LT(footprint_area(name), 1.12 * raster + 1e-4) << name;
  }
}

TEST(Furniture, TurnedShapesKeepTheirFootprintArea) {
  for (const std::string_view name : furniture_shapes()) {
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(3.1, -2.7, 0.4) * Eigen::AngleAxisd(0.7, Vector3d::UnitZ());
    const auto turned = footprint(transformed(shape(name), motion));
    ASSERT_TRUE(turned) << name << " " << to_string(turned.error());
    EXPECT_NEAR(area_m2(*turned), footprint_area(name), 3e-3 * footprint_area(name) + 3e-5) << name;
  }
}

TEST(Furniture, AChairHasItsBackBehindAndItsSeatBelowTheMiddle) {
  const TriangleMesh chair = shape("chair");
  for (const Eigen::Vector3f& vertex : chair.vertices) {
    if (vertex.z() < 0.6F) continue;
    EXPECT_LT(vertex.x(), 0.0F);  // the back, for who looks along +x
  }
}

TEST(Furniture, ColoursReplaceTheUsualOnes) {
  const auto mesh = build_furniture({"cup", Vector3d::Zero(), {{1, 2, 3}}});
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(std::ranges::any_of(mesh->materials, [](const SurfaceMaterial& material) {
    return material.color == Rgb8{1, 2, 3};
  }));
}

TEST(Furniture, AnUnknownShapeNamesThoseThereAre) {
  const auto mesh = build_furniture({"piano", Vector3d::Zero(), {}});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(mesh.error().field, "shape");
  EXPECT_THAT(mesh.error().what,
              testing::AllOf(testing::HasSubstr("piano"), testing::HasSubstr("umbrella")));
}

TEST(Furniture, SizesBeyondReasonAreRefused) {
  for (const double size : {-1.0, 0.001, 21.0, std::nan("")}) {
    const auto mesh = build_furniture({"cup", {size, 0.0, 0.0}, {}});
    ASSERT_FALSE(mesh) << size;
    EXPECT_EQ(mesh.error().field, "size");
  }
}

}  // namespace
}  // namespace hypermap
