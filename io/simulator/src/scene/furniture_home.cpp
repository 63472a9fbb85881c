// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hypermap {

using Eigen::Vector3d;

TriangleMesh build_bed(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double mattress = 0.55 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kWood});
  mesh.box({-x, -y, 0.0}, {-x + 0.06, y, top});  // head end
  mesh.box({-x + 0.06, -y + 0.02, 0.12}, {x - 0.02, y - 0.02, 0.5 * mattress});
  for (const double side : {-y + 0.04, y - 0.12})
    mesh.box({x - 0.16, side, 0.0}, {x - 0.08, side + 0.08, 0.12});
  mesh.material({{238, 236, 230}, SurfacePattern::kFabric});
  mesh.box({-x + 0.06, -y + 0.03, 0.5 * mattress}, {x - 0.03, y - 0.03, mattress - 0.04});
  for (const double side : {-0.48 * y, 0.48 * y})  // pillows
    mesh.ellipsoid({-x + 0.32, side, mattress - 0.04}, {0.22, 0.4 * y, 0.13}, true);
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.box({-x + 0.55, -y, 0.35 * mattress}, {x, y, mattress});  // the cover hangs over the edges
  return mesh.build();
}

TriangleMesh build_refrigerator(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double split = 0.36 * top;
  MeshBuilder mesh;
  mesh.material({{60, 60, 62}, SurfacePattern::kPlain});
  mesh.box({-x + 0.02, -y + 0.02, 0.0}, {x - 0.1, y - 0.02, 0.06});
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.06}, {x - 0.07, y, top});
  mesh.box({x - 0.075, -y, 0.08}, {x - 0.03, y, split - 0.006});
  mesh.box({x - 0.075, -y, split + 0.006}, {x - 0.03, y, top});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.box({x - 0.035, y - 0.09, split - 0.35}, {x, y - 0.06, split - 0.06});
  mesh.box({x - 0.035, y - 0.09, split + 0.06}, {x, y - 0.06, split + 0.45});
  return mesh.build();
}

TriangleMesh build_oven(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.0}, {x - 0.05, y, top - 0.012});
  mesh.box({x - 0.055, -y + 0.005, 0.86 * top}, {x - 0.04, y - 0.005, top - 0.02});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.box({-x, -y, top - 0.012}, {x - 0.04, y, top});                              // hob
  mesh.box({x - 0.055, -y + 0.01, 0.16 * top}, {x - 0.035, y - 0.01, 0.83 * top});  // door
  mesh.material({{90, 92, 96}, SurfacePattern::kPlain});
  mesh.box({x - 0.04, -0.8 * y, 0.76 * top}, {x, 0.8 * y, 0.785 * top});
  for (int i = 0; i < 5; ++i) {
    const double side = y * (-0.6 + 0.3 * i);
    mesh.frustum({x - 0.04, side, 0.925 * top}, {x - 0.012, side, 0.925 * top}, 0.02, 0.017);
  }
  return mesh.build();
}

TriangleMesh build_microwave(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.012}, {x - 0.025, y, top});
  for (const double side : {-0.8 * y, 0.8 * y})
    mesh.box({-0.8 * x, side - 0.02, 0.0}, {0.8 * x, side + 0.02, 0.012});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.box({x - 0.03, -y + 0.01, 0.03}, {x - 0.015, 0.42 * y, top - 0.02});
  mesh.material({{90, 150, 120}, SurfacePattern::kKeys});
  mesh.box({x - 0.03, 0.52 * y, 0.05}, {x - 0.02, 0.92 * y, top - 0.05});
  mesh.material({{120, 122, 126}, SurfacePattern::kPlain});
  mesh.box({x - 0.02, 0.36 * y, 0.06}, {x, 0.42 * y, top - 0.05});
  return mesh.build();
}

TriangleMesh build_lamp(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  const double shade = 0.6 * top;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0}, {0, 0, 0.03}, 0.6 * radius, 0.5 * radius);
  mesh.bar(std::array{Vector3d(0, 0, 0.03), Vector3d(0, 0, 0.8 * top)}, 0.012);
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.frustum({0, 0, shade}, {0, 0, top}, radius, 0.65 * radius, false);
  mesh.ring({0, 0, 0.9 * top}, 0.0, 0.7 * radius);
  return mesh.build();
}

TriangleMesh build_vase(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  const std::array<std::array<double, 2>, 6> outline{
      {{0.0, 0.55}, {0.18, 0.85}, {0.4, 1.0}, {0.65, 0.75}, {0.85, 0.45}, {1.0, 0.6}}};
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    if (i == 2) mesh.material({in.second, SurfacePattern::kPlain});
    if (i == 3) mesh.material({in.first, SurfacePattern::kPlain});
    mesh.frustum({0, 0, outline[i][0] * top},
                 {0, 0, outline[i + 1][0] * top},
                 outline[i][1] * radius,
                 outline[i + 1][1] * radius,
                 false);
  }
  mesh.ring({0, 0, 0.0}, 0.0, 0.55 * radius);
  mesh.ring({0, 0, 0.86 * top}, 0.0, 0.46 * radius);
  return mesh.build();
}

}  // namespace hypermap
