// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

using Eigen::Vector3d;

/// Four upright posts from the floor at the corners of a rectangle around the origin.
void add_legs(MeshBuilder& mesh, double half_x, double half_y, double height, double thickness) {
  const double t = 0.5 * thickness;
  for (const double x : {-half_x + t, half_x - t}) {
    for (const double y : {-half_y + t, half_y - t})
      mesh.box({x - t, y - t, 0.0}, {x + t, y + t, height});
  }
}

}  // namespace

TriangleMesh build_chair(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double seat = 0.52 * top;
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kWood});
  add_legs(mesh, x - 0.01, y - 0.01, seat - 0.03, 0.04);
  for (const double side : {-y + 0.01, y - 0.05})  // uprights of the back
    mesh.box({-x, side, seat}, {-x + 0.035, side + 0.04, top});
  mesh.box({-x + 0.005, -y + 0.05, 0.93 * top}, {-x + 0.03, y - 0.05, top});
  mesh.material({in.second, SurfacePattern::kFabric});
  mesh.box({-x, -y, seat - 0.03}, {x, y, seat + 0.015});
  mesh.box({-x + 0.002, -y + 0.03, 0.68 * top}, {-x + 0.04, y - 0.03, 0.9 * top});
  return mesh.build();
}

TriangleMesh build_swivel_chair(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  const double seat = 0.48 * top;
  const double half = 0.78 * radius;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (int arm = 0; arm < 5; ++arm) {
    const double angle = std::numbers::pi * (1.0 + 0.4 * arm);
    const Vector3d out{std::cos(angle), std::sin(angle), 0.0};
    mesh.bar(
        std::array{Vector3d(0.0, 0.0, 0.11), Vector3d(0.9 * radius * out + Vector3d(0, 0, 0.07))},
        0.02);
    mesh.ellipsoid(0.9 * radius * out + Vector3d(0.0, 0.0, 0.03), {0.03, 0.03, 0.03});
  }
  mesh.frustum({0, 0, 0.08}, {0, 0, seat - 0.06}, 0.035, 0.025);
  mesh.bar(std::array{Vector3d(-0.4 * half, 0, seat - 0.05),
                      Vector3d(-half - 0.02, 0, seat - 0.02),
                      Vector3d(-half - 0.03, 0, 0.75 * top)},
           0.022);
  for (const double side : {-half - 0.03, half + 0.03}) {  // armrests
    mesh.bar(std::array{Vector3d(0, side, seat - 0.04), Vector3d(0, side, seat + 0.2)}, 0.018);
    mesh.box({-0.6 * half, side - 0.025, seat + 0.2}, {0.6 * half, side + 0.025, seat + 0.225});
  }
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.box({-half, -half, seat - 0.05}, {half, half, seat + 0.03});
  mesh.ellipsoid({0, 0, seat + 0.025}, {half, half, 0.03}, true);
  mesh.box({-half - 0.02, -0.9 * half, seat + 0.13}, {-half + 0.05, 0.9 * half, 0.94 * top});
  mesh.box({-half - 0.01, -0.7 * half, 0.94 * top}, {-half + 0.04, 0.7 * half, top});
  return mesh.build();
}

TriangleMesh build_sofa(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double seat = 0.52 * top;
  const double arm = 0.18;
  MeshBuilder mesh;
  mesh.material({{60, 44, 34}, SurfacePattern::kWood});
  add_legs(mesh, x - 0.04, y - 0.04, 0.1, 0.06);
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.box({-x, -y, 0.08}, {x - 0.02, y, seat - 0.12});
  mesh.box({-x, -y, 0.08}, {-x + 0.22, y, top - 0.03});
  for (const double side : {-y, y - arm}) {
    mesh.box({-x, side, 0.08}, {x, side + arm, 0.7 * top});
    mesh.frustum({-x + 0.02, side + 0.5 * arm, 0.7 * top},
                 {x, side + 0.5 * arm, 0.7 * top},
                 0.5 * arm,
                 0.5 * arm);
  }
  mesh.material({in.second, SurfacePattern::kFabric});
  const double inner = 2.0 * (y - arm);
  const int num_cushions = inner > 1.7 ? 3 : 2;
  const double width = inner / num_cushions;
  for (int i = 0; i < num_cushions; ++i) {
    const double left = -0.5 * inner + i * width;
    mesh.box({-x + 0.2, left + 0.01, seat - 0.12}, {x - 0.01, left + width - 0.01, seat});
    mesh.box({-x + 0.2, left + 0.02, seat}, {-x + 0.34, left + width - 0.02, top});
  }
  return mesh.build();
}

TriangleMesh build_bench(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double seat = 0.55 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (const double side : {-y + 0.12, y - 0.17}) {
    mesh.box({-x + 0.05, side, 0.0}, {-x + 0.10, side + 0.05, top - 0.02});
    mesh.box({x - 0.10, side, 0.0}, {x - 0.05, side + 0.05, seat - 0.03});
    mesh.box({-x + 0.05, side, seat - 0.07}, {x - 0.05, side + 0.05, seat - 0.03});
  }
  mesh.material({in.first, SurfacePattern::kWood});
  constexpr int kSlats = 4;
  const double pitch = (2.0 * x - 0.1) / kSlats;
  for (int i = 0; i < kSlats; ++i) {
    const double from = -x + 0.1 + i * pitch;
    mesh.box({from, -y, seat - 0.03}, {from + pitch - 0.002, y, seat});
  }
  for (const double height : {0.68, 0.85})
    mesh.box({-x + 0.08, -y, height * top}, {-x + 0.11, y, (height + 0.13) * top});
  return mesh.build();
}

}  // namespace hypermap
