// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {

using Eigen::Vector3d;

TriangleMesh build_monitor(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double bottom = 0.28 * top;
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -0.45 * y, 0.0}, {x, 0.45 * y, 0.015});
  mesh.box({-0.5 * x - 0.015, -0.05, 0.0}, {-0.5 * x + 0.015, 0.05, 0.7 * top});
  mesh.box({-0.5 * x, -0.5 * y, bottom + 0.06}, {-0.02, 0.5 * y, top - 0.06});  // housing behind
  mesh.box({-0.02, -y, bottom}, {0.02, y, top});
  mesh.material({in.second, SurfacePattern::kScreen});
  mesh.box({0.019, -y + 0.015, bottom + 0.02}, {0.022, y - 0.015, top - 0.015});
  return mesh.build();
}

TriangleMesh build_keyboard(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.0}, {x, y, 0.6 * top});
  mesh.material({in.second, SurfacePattern::kKeys});
  mesh.box({-x + 0.012, -y + 0.012, 0.6 * top}, {x - 0.012, y - 0.012, top});
  return mesh.build();
}

TriangleMesh build_laptop(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double hinge = -0.35 * x;  // the lid leans back from here
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({hinge, -y, 0.0}, {x, y, 0.016});
  const double lean = std::atan2(x + hinge, top - 0.016);
  mesh.placed(Eigen::Translation3d(hinge, 0.0, 0.016) *
              Eigen::AngleAxisd(-lean, Vector3d::UnitY()));
  const double lid = std::hypot(x + hinge, top - 0.016);
  mesh.box({-0.008, -y, 0.0}, {0.0, y, lid});
  mesh.material({in.second, SurfacePattern::kScreen});
  mesh.box({0.0, -y + 0.012, 0.014}, {0.001, y - 0.012, lid - 0.012});
  mesh.placed(Eigen::Isometry3d::Identity());
  mesh.material({{50, 50, 54}, SurfacePattern::kKeys});
  mesh.box({hinge + 0.03, -y + 0.02, 0.016}, {0.5 * x, y - 0.02, 0.018});
  return mesh.build();
}

TriangleMesh build_mouse(const ShapeInput& in) {
  const Vector3d radii{0.5 * in.size_m.x(), 0.5 * in.size_m.y(), in.size_m.z()};
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.ellipsoid({0, 0, 0}, radii, true);
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.ellipsoid({0.45 * radii.x(), 0, 0.85 * radii.z()}, {0.012, 0.005, 0.006});  // the wheel
  return mesh.build();
}

TriangleMesh build_cup(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  const double wall = 0.004;
  const double reach = in.size_m.y() - in.size_m.x();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0}, {0, 0, top}, 0.88 * radius, radius, false);
  mesh.ring({0, 0, 0.0}, 0.0, 0.88 * radius);
  mesh.ring({0, 0, top}, radius - wall, radius);
  std::vector<Vector3d> handle;
  for (int i = 0; i <= 6; ++i) {
    const double angle = std::numbers::pi * (i / 6.0 - 0.5);
    handle.emplace_back(
        0.0, 0.9 * radius + reach * std::cos(angle), top * (0.5 + 0.3 * std::sin(angle)));
  }
  mesh.bar(handle, 0.006);
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0.006}, {0, 0, top}, 0.88 * radius - wall, radius - wall, false);
  mesh.material({{70, 44, 28}, SurfacePattern::kPlain});  // coffee
  mesh.ring({0, 0, 0.7 * top}, 0.0, 0.93 * radius - wall);
  return mesh.build();
}

}  // namespace hypermap
