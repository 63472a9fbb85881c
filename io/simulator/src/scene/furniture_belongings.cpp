// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

using Eigen::Vector3d;

/// A point of an umbrella's canopy: `out` of 0 at the tip to 1 at the rim, around the shaft.
Vector3d canopy_point(double radius, double depth, double out, double around) {
  return {radius * std::sin(0.5 * std::numbers::pi * out) * std::cos(around),
          radius * std::sin(0.5 * std::numbers::pi * out) * std::sin(around),
          -depth * out * out};
}

void add_canopy(MeshBuilder& mesh, const ShapeInput& in, double radius, double depth) {
  constexpr int kPanels = 8;
  constexpr int kSteps = 4;
  for (int panel = 0; panel < kPanels; ++panel) {
    mesh.material({panel % 2 == 0 ? in.first : in.second, SurfacePattern::kFabric});
    const double left = 2.0 * std::numbers::pi * panel / kPanels;
    const double right = 2.0 * std::numbers::pi * (panel + 1) / kPanels;
    for (int step = 0; step < kSteps; ++step) {
      const double from = static_cast<double>(step) / kSteps;
      const double to = static_cast<double>(step + 1) / kSteps;
      mesh.sheet(std::array{canopy_point(radius, depth, from, left),
                            canopy_point(radius, depth, to, left),
                            canopy_point(radius, depth, to, right),
                            canopy_point(radius, depth, from, right)});
    }
  }
}

/// A layer of leaves around a stem, at even angles.
void add_leaves(
    MeshBuilder& mesh, const Vector3d& stem, double length, double rise, int count, double turn) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + turn) / count;
    const double reach = length * (0.85 + 0.15 * std::cos(3.0 * i));
    mesh.leaf(stem,
              stem + Vector3d(reach * std::cos(angle), reach * std::sin(angle), rise),
              2.6 * length / count + 0.05);
  }
}

}  // namespace

TriangleMesh build_suitcase(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double body = 0.72 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (const double wheel_x : {-x + 0.04, x - 0.04}) {
    for (const double wheel_y : {-y + 0.05, y - 0.05})
      mesh.ellipsoid({wheel_x, wheel_y, 0.025}, {0.025, 0.02, 0.025});
  }
  mesh.bar(std::array{Vector3d(-x + 0.03, -0.09, body),
                      Vector3d(-x + 0.03, -0.09, top - 0.01),
                      Vector3d(-x + 0.03, 0.09, top - 0.01),
                      Vector3d(-x + 0.03, 0.09, body)},
           0.01);
  mesh.bar(std::array{Vector3d(0.03, -0.07, body),
                      Vector3d(0.03, -0.05, body + 0.03),
                      Vector3d(0.03, 0.05, body + 0.03),
                      Vector3d(0.03, 0.07, body)},
           0.01);
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x + 0.01, -y + 0.01, 0.04}, {x - 0.01, y - 0.01, body});
  constexpr int kRibs = 5;
  for (int i = 0; i < kRibs; ++i) {  // a hard shell with ribs
    const double middle = -y + (i + 0.5) * 2.0 * y / kRibs;
    mesh.box({-x, middle - 0.02, 0.06}, {x, middle + 0.02, body - 0.02});
  }
  return mesh.build();
}

TriangleMesh build_umbrella(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.y();
  const double depth = 0.45 * radius;
  const double length = 1.75 * radius;
  // Open, lying on its rim and the end of its handle: the rim is `depth` below the tip and `radius`
  // aside, the handle's end `length` below it, and both touch the floor.
  const double tilt = std::atan2(radius, length - depth);
  MeshBuilder mesh;
  mesh.placed(
      Eigen::Isometry3d(Eigen::AngleAxisd(0.5 * std::numbers::pi - tilt, Vector3d::UnitY())));
  add_canopy(mesh, in, radius, depth);
  mesh.material({{40, 40, 42}, SurfacePattern::kPlain});
  mesh.bar(std::array{Vector3d(0, 0, 0.04), Vector3d(0, 0, -length + 0.08)}, 0.008);
  mesh.bar(std::array{Vector3d(0, 0, -length + 0.08),
                      Vector3d(0, 0, -length + 0.02),
                      Vector3d(0, 0.03, -length),
                      Vector3d(0, 0.06, -length + 0.03)},
           0.013);
  return mesh.build();
}

TriangleMesh build_backpack(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.box({-x + 0.03, -0.92 * y, 0.0}, {0.5 * x, 0.92 * y, 0.7 * top});
  mesh.ellipsoid({-0.25 * x + 0.015, 0, 0.68 * top}, {0.75 * x - 0.02, 0.92 * y, 0.3 * top}, true);
  mesh.ellipsoid({-0.25 * x + 0.015, 0, 0.35 * top}, {0.6 * x, y, 0.33 * top});
  mesh.material({in.second, SurfacePattern::kFabric});
  mesh.box({0.4 * x, -0.7 * y, 0.03}, {0.85 * x, 0.7 * y, 0.4 * top});  // front pocket
  mesh.ellipsoid({0.45 * x, 0, 0.39 * top}, {0.5 * x, 0.7 * y, 0.08 * top}, true);
  mesh.material({{30, 30, 34}, SurfacePattern::kFabric});
  for (const double side : {-0.5 * y, 0.5 * y})
    mesh.bar(std::array{Vector3d(-x + 0.03, side, 0.85 * top),
                        Vector3d(-x + 0.012, side, 0.6 * top),
                        Vector3d(-x + 0.012, side, 0.25 * top),
                        Vector3d(-x + 0.03, side, 0.05 * top)},
             0.012);
  mesh.bar(std::array{Vector3d(-0.4 * x, -0.2 * y, 0.94 * top),
                      Vector3d(-0.4 * x, -0.12 * y, top - 0.01),
                      Vector3d(-0.4 * x, 0.12 * y, top - 0.01),
                      Vector3d(-0.4 * x, 0.2 * y, 0.94 * top)},
           0.01);
  return mesh.build();
}

TriangleMesh build_plant(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  const double pot = 0.28 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0}, {0, 0, pot}, 0.32 * radius, 0.45 * radius, false);
  mesh.frustum({0, 0, pot - 0.05}, {0, 0, pot}, 0.49 * radius, 0.49 * radius, false);
  mesh.ring({0, 0, pot}, 0.44 * radius, 0.49 * radius);
  mesh.ring({0, 0, 0}, 0.0, 0.32 * radius);
  mesh.material({{62, 44, 30}, SurfacePattern::kFabric});
  mesh.ring({0, 0, pot - 0.03}, 0.0, 0.46 * radius);
  mesh.frustum({0, 0, pot - 0.04}, {0.02, 0.01, 0.8 * top}, 0.02, 0.01, true, 8);
  mesh.material({in.first, SurfacePattern::kFabric});
  add_leaves(mesh, {0.0, 0.0, 0.36 * top}, radius, 0.10 * top, 13, 0.0);
  add_leaves(mesh, {0.01, 0.0, 0.50 * top}, 0.97 * radius, 0.14 * top, 12, 0.5);
  mesh.material(
      {{in.first.r, static_cast<std::uint8_t>(in.first.g + (255 - in.first.g) / 6), in.first.b},
       SurfacePattern::kFabric});
  add_leaves(mesh, {0.01, 0.01, 0.62 * top}, 0.8 * radius, 0.2 * top, 10, 0.25);
  add_leaves(mesh, {0.02, 0.01, 0.74 * top}, 0.45 * radius, 0.24 * top, 7, 0.7);
  return mesh.build();
}

}  // namespace hypermap
