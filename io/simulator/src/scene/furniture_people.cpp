// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <array>

namespace hypermap {

using Eigen::Vector3d;

TriangleMesh build_person(const ShapeInput& in) {
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double hip = 0.5 * top;
  const double shoulder = 0.82 * top;
  const double stride = 0.5 * in.size_m.x();
  const Rgb8 skin{214, 170, 140};
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kFabric});
  for (const double side : {-0.4 * y, 0.4 * y}) {  // in mid-stride: one foot before the other
    const double foot = (side < 0.0 ? -1.0 : 1.0) * (stride - 0.14);
    mesh.frustum({foot, side, 0.05}, {0.5 * foot, side, 0.5 * hip}, 0.05, 0.065);
    mesh.frustum({0.5 * foot, side, 0.5 * hip}, {0.0, side, hip}, 0.065, 0.085);
    mesh.box({foot - 0.08, side - 0.045, 0.0}, {foot + 0.14, side + 0.045, 0.07});
  }
  mesh.ellipsoid({0, 0, hip}, {0.13, 0.72 * y, 0.1});
  mesh.material({in.first, SurfacePattern::kFabric});
  mesh.frustum({0, 0, hip}, {0, 0, 0.95 * shoulder}, 0.14, 0.15);
  mesh.ellipsoid({0, 0, 0.92 * shoulder}, {0.13, 0.85 * y, 0.09 * top});
  for (const double side : {-y + 0.05, y - 0.05}) {
    const double swing = side < 0.0 ? 0.15 : -0.15;
    mesh.bar(std::array{Vector3d(0, 0.9 * side, 0.96 * shoulder),
                        Vector3d(0.3 * swing, side, 0.75 * shoulder),
                        Vector3d(swing, side, 0.6 * shoulder)},
             0.045);
  }
  mesh.material({skin, SurfacePattern::kPlain});
  mesh.frustum({0, 0, shoulder}, {0, 0, 0.89 * top}, 0.055, 0.05);
  mesh.ellipsoid({0.01, 0, 0.93 * top}, {0.095, 0.075, 0.07 * top});
  mesh.material({{52, 38, 30}, SurfacePattern::kFabric});
  mesh.ellipsoid({-0.01, 0, 0.945 * top}, {0.1, 0.082, 0.055 * top}, true);
  return mesh.build();
}

}  // namespace hypermap
