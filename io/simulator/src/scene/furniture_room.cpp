// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Eigen::Vector3d;

/// Points of a circle in the plane x = centre.x, closed.
std::vector<Vector3d> upright_circle(const Vector3d& centre, double radius) {
  constexpr int kCorners = 24;
  std::vector<Vector3d> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    points.push_back(centre + radius * Vector3d(0.0, std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// The cage of a fan: two rims and spokes that bulge to the front and back.
void add_cage(MeshBuilder& mesh, const Vector3d& hub, double radius, double half_depth) {
  mesh.bar(upright_circle(hub, radius), 0.008);
  mesh.bar(upright_circle(hub + Vector3d(0.7 * half_depth, 0, 0), 0.6 * radius), 0.004);
  mesh.bar(upright_circle(hub - Vector3d(0.7 * half_depth, 0, 0), 0.6 * radius), 0.004);
  constexpr int kSpokes = 24;
  for (int i = 0; i < kSpokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSpokes;
    const Vector3d out{0.0, std::cos(angle), std::sin(angle)};
    for (const double front : {half_depth, -half_depth})
      mesh.bar(std::array{Vector3d(hub + radius * out),
                          Vector3d(hub + 0.6 * radius * out + Vector3d(0.7 * front, 0, 0)),
                          Vector3d(hub + Vector3d(front, 0, 0))},
               0.003);
  }
}

void add_blades(MeshBuilder& mesh, const Vector3d& hub, double radius) {
  constexpr int kBlades = 4;
  for (int i = 0; i < kBlades; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kBlades + 0.3;
    const Vector3d out{0.0, std::cos(angle), std::sin(angle)};
    const Vector3d side = Vector3d::UnitX().cross(out);
    const Vector3d twist{0.03, 0.0, 0.0};
    mesh.sheet(std::array{Vector3d(hub + 0.1 * radius * out),
                          Vector3d(hub + 0.6 * radius * out + 0.3 * radius * side + twist),
                          Vector3d(hub + 0.85 * radius * out + 0.1 * radius * side),
                          Vector3d(hub + 0.8 * radius * out - 0.2 * radius * side - twist)});
  }
}

}  // namespace

TriangleMesh build_table(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (const double leg_x : {-x + 0.06, x - 0.06}) {
    for (const double leg_y : {-y + 0.06, y - 0.06})
      mesh.frustum({leg_x, leg_y, 0.0}, {leg_x, leg_y, top - 0.03}, 0.025, 0.025);
  }
  for (const double beam_x : {-x + 0.05, x - 0.07})
    mesh.box({beam_x, -y + 0.06, top - 0.08}, {beam_x + 0.02, y - 0.06, top - 0.03});
  mesh.material({in.first, SurfacePattern::kWood});
  mesh.box({-x, -y, top - 0.03}, {x, y, top});
  return mesh.build();
}

TriangleMesh build_cupboard(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({{70, 70, 72}, SurfacePattern::kPlain});
  mesh.box({-x, -y + 0.02, 0.0}, {x - 0.08, y - 0.02, 0.1});
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.1}, {x - 0.04, y, top - 0.03});
  const int num_doors = std::max(1, static_cast<int>(std::lround(in.size_m.y() / 0.6)));
  const double width = 2.0 * y / num_doors;
  for (int i = 0; i < num_doors; ++i) {
    const double left = -y + i * width;
    mesh.material({in.first, SurfacePattern::kPlain});
    mesh.box({x - 0.04, left + 0.008, 0.11}, {x - 0.02, left + width - 0.008, top - 0.05});
    mesh.material({{120, 120, 124}, SurfacePattern::kPlain});
    mesh.box({x - 0.02, left + width - 0.09, 0.55 * top},
             {x - 0.004, left + width - 0.07, 0.75 * top});
  }
  mesh.material({in.second, SurfacePattern::kWood});
  mesh.box({-x, -y, top - 0.03}, {x, y, top});
  return mesh.build();
}

TriangleMesh build_sink(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double rim = in.size_m.z() - 0.13;
  const double floor = rim - 0.15;
  const double wall = 0.035;
  const double shelf = 0.09;  // behind the bowl, where the tap stands
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.frustum({-0.3 * x, 0, 0}, {-0.3 * x, 0, floor}, 0.11, 0.085);
  mesh.box({-x, -y, floor - 0.03}, {x, y, floor});
  mesh.box({-x, -y, floor}, {-x + shelf, y, rim});
  mesh.box({x - wall, -y, floor}, {x, y, rim});
  mesh.box({-x + shelf, -y, floor}, {x - wall, -y + wall, rim});
  mesh.box({-x + shelf, y - wall, floor}, {x - wall, y, rim});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.ring({0.15 * x, 0, floor + 0.002}, 0.0, 0.025);
  mesh.frustum({-x + 0.045, 0, rim}, {-x + 0.045, 0, rim + 0.02}, 0.03, 0.025);
  mesh.bar(std::array{Vector3d(-x + 0.045, 0, rim),
                      Vector3d(-x + 0.045, 0, rim + 0.11),
                      Vector3d(-x + 0.10, 0, rim + 0.12),
                      Vector3d(-x + 0.17, 0, rim + 0.08)},
           0.013);
  return mesh.build();
}

TriangleMesh build_bin(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0.0}, {0, 0, top - 0.03}, 0.75 * radius, 0.96 * radius, false);
  mesh.frustum({0, 0, top - 0.04}, {0, 0, top}, radius, radius, false);
  mesh.ring({0, 0, top}, 0.93 * radius, radius);
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0.01}, {0, 0, top}, 0.72 * radius, 0.93 * radius, false);
  mesh.ring({0, 0, 0.01}, 0.0, 0.74 * radius);
  return mesh.build();
}

TriangleMesh build_fan(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.y();
  const double foot = 0.5 * in.size_m.x();
  const Vector3d hub{0.07, 0.0, in.size_m.z() - radius};
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0}, {0, 0, 0.03}, foot, 0.85 * foot);
  mesh.frustum({-0.05, 0, hub.z() - 0.06}, {-0.02, 0, hub.z() + 0.06}, 0.045, 0.055);
  mesh.frustum({-0.13, 0, hub.z()}, {0.02, 0, hub.z()}, 0.06, 0.07);
  add_cage(mesh, hub, radius - 0.008, 0.09);
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0.02}, {-0.03, 0, hub.z() - 0.05}, 0.022, 0.016);
  mesh.ellipsoid(hub + Vector3d(0.07, 0, 0), {0.03, 0.05, 0.05});
  mesh.material({{90, 150, 190}, SurfacePattern::kPlain});
  add_blades(mesh, hub, 0.95 * radius);
  return mesh.build();
}

TriangleMesh build_noteboard(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double bottom = 0.45 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (const double side : {-y + 0.06, y - 0.06}) {
    mesh.box({-0.02, side - 0.02, 0.06}, {0.02, side + 0.02, top - 0.02});
    mesh.box({-x, side - 0.025, 0.05}, {x, side + 0.025, 0.09});
    for (const double end : {-x + 0.03, x - 0.03})
      mesh.ellipsoid({end, side, 0.03}, {0.03, 0.02, 0.03});
  }
  mesh.box({-0.015, -y + 0.06, 0.2}, {0.015, y - 0.06, 0.24});
  mesh.box({-0.03, -y, bottom - 0.03}, {0.03, y, bottom});
  mesh.box({-0.03, -y, top - 0.03}, {0.03, y, top});
  for (const double side : {-y, y - 0.03})
    mesh.box({-0.03, side, bottom}, {0.03, side + 0.03, top});
  mesh.box({0.02, -0.4 * y, bottom}, {0.09, 0.4 * y, bottom + 0.015});  // tray for pens
  mesh.material({in.first, SurfacePattern::kNotes});
  mesh.box({-0.022, -y + 0.02, bottom}, {0.022, y - 0.02, top - 0.02});
  return mesh.build();
}

}  // namespace hypermap
