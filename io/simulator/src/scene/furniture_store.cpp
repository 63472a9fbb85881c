// SPDX-License-Identifier: BSD-3-Clause
#include "furniture_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {

using Eigen::Vector3d;

TriangleMesh build_shelf(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  constexpr int kBoards = 4;
  constexpr double kPost = 0.035;
  constexpr double kBoard = 0.025;
  MeshBuilder mesh;
  mesh.material({in.second, SurfacePattern::kPlain});
  for (const double post_x : {-x, x - kPost}) {
    for (const double post_y : {-y, y - kPost})
      mesh.box({post_x, post_y, 0.0}, {post_x + kPost, post_y + kPost, top});
  }
  mesh.material({in.first, SurfacePattern::kWood});
  for (int i = 0; i < kBoards; ++i) {  // the highest is the top, the lowest 12 cm above the floor
    const double height = 0.12 + (top - 0.12) * i / (kBoards - 1);
    mesh.box({-x, -y, height - kBoard}, {x, y, height});
  }
  return mesh.build();
}

TriangleMesh build_crate(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kWood});
  mesh.box({-x + 0.008, -y + 0.008, 0.0}, {x - 0.008, y - 0.008, top - 0.004});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.8 * top}, {x, y, top});  // lid
  mesh.box({-0.2 * x, -y, 0.0}, {0.2 * x, y, 0.8 * top});
  return mesh.build();
}

TriangleMesh build_bottle(const ShapeInput& in) {
  const double radius = 0.5 * in.size_m.x();
  const double top = in.size_m.z();
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0}, {0, 0, 0.6 * top}, radius, radius);
  mesh.frustum({0, 0, 0.6 * top}, {0, 0, 0.78 * top}, radius, 0.38 * radius, false);
  mesh.frustum({0, 0, 0.78 * top}, {0, 0, 0.93 * top}, 0.38 * radius, 0.36 * radius, false);
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.frustum({0, 0, 0.93 * top}, {0, 0, top}, 0.42 * radius, 0.42 * radius);
  mesh.frustum({0, 0, 0.2 * top}, {0, 0, 0.48 * top}, 1.01 * radius, 1.01 * radius, false);
  return mesh.build();
}

TriangleMesh build_book(const ShapeInput& in) {
  const double x = 0.5 * in.size_m.x();
  const double y = 0.5 * in.size_m.y();
  const double top = in.size_m.z();
  const double cover = std::min(0.004, 0.2 * top);
  MeshBuilder mesh;
  mesh.material({in.first, SurfacePattern::kPlain});
  mesh.box({-x, -y, 0.0}, {x, y, cover});
  mesh.box({-x, -y, top - cover}, {x, y, top});
  mesh.box({-x, -y, 0.0}, {-x + 0.01, y, top});
  mesh.material({in.second, SurfacePattern::kPlain});
  mesh.box({-x + 0.01, -y + 0.005, cover}, {x - 0.006, y - 0.005, top - cover});
  return mesh.build();
}

}  // namespace hypermap
