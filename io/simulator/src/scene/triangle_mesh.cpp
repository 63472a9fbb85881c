// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

/// Two unit vectors that stand on `axis` and on each other.
std::array<Eigen::Vector3d, 2> perpendicular(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d n = axis.normalized();
  const Eigen::Vector3d helper =
      std::abs(n.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d a = n.cross(helper).normalized();
  return {a, n.cross(a)};
}

}  // namespace

MeshBuilder& MeshBuilder::material(SurfaceMaterial material) {
  const auto found = std::ranges::find(mesh_.materials, material);
  material_ = static_cast<std::uint16_t>(found - mesh_.materials.begin());
  if (found == mesh_.materials.end()) mesh_.materials.push_back(material);
  return *this;
}

MeshBuilder& MeshBuilder::placed(const Eigen::Isometry3d& mesh_from_solid) {
  mesh_from_solid_ = mesh_from_solid;
  return *this;
}

std::uint32_t MeshBuilder::vertex(const Eigen::Vector3d& in_solid) {
  mesh_.vertices.push_back((mesh_from_solid_ * in_solid).cast<float>());
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (mesh_.materials.empty()) material({});
  mesh_.triangles.push_back({a, b, c});
  mesh_.material_of_triangle.push_back(material_);
}

void MeshBuilder::begin_part() {
  mesh_.parts.push_back({static_cast<std::uint32_t>(mesh_.vertices.size()), 0});
}

void MeshBuilder::end_part() {
  TriangleMesh::Part& part = mesh_.parts.back();
  part.count = static_cast<std::uint32_t>(mesh_.vertices.size()) - part.first;
}

MeshBuilder& MeshBuilder::box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  begin_part();
  std::array<std::uint32_t, 8> corner{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    corner[i] = vertex({(i & 1U) != 0 ? max.x() : min.x(),
                        (i & 2U) != 0 ? max.y() : min.y(),
                        (i & 4U) != 0 ? max.z() : min.z()});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& face : kFaces) {
    triangle(corner[face[0]], corner[face[1]], corner[face[2]]);
    triangle(corner[face[0]], corner[face[2]], corner[face[3]]);
  }
  end_part();
  return *this;
}

MeshBuilder& MeshBuilder::frustum(const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& to,
                                  double radius_from_m,
                                  double radius_to_m,
                                  bool capped,
                                  int num_sides) {
  begin_part();
  const auto [a, b] = perpendicular(to - from);
  const auto n = static_cast<std::uint32_t>(num_sides);
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const Eigen::Vector3d out = std::cos(angle) * a + std::sin(angle) * b;
    vertex(from + radius_from_m * out);
    vertex(to + radius_to_m * out);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t here = first + 2 * i;
    const std::uint32_t next = first + 2 * ((i + 1) % n);
    triangle(here, next, next + 1);
    triangle(here, next + 1, here + 1);
  }
  for (std::uint32_t i = 1; capped && i + 1 < n; ++i) {
    triangle(first, first + 2 * i, first + 2 * (i + 1));
    triangle(first + 1, first + 2 * i + 1, first + 2 * (i + 1) + 1);
  }
  end_part();
  return *this;
}

MeshBuilder& MeshBuilder::ellipsoid(const Eigen::Vector3d& centre,
                                    const Eigen::Vector3d& radii,
                                    bool upper_half) {
  constexpr std::uint32_t kAround = 20;
  constexpr std::uint32_t kUp = 10;
  begin_part();
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  const double lowest = upper_half ? 0.0 : -0.5 * std::numbers::pi;
  for (std::uint32_t j = 0; j <= kUp; ++j) {
    const double up = lowest + (0.5 * std::numbers::pi - lowest) * j / kUp;
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double around = 2.0 * std::numbers::pi * i / kAround;
      const Eigen::Vector3d unit{
          std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up)};
      vertex(centre + radii.cwiseProduct(unit));
    }
  }
  for (std::uint32_t j = 0; j < kUp; ++j) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t here = first + j * kAround + i;
      const std::uint32_t next = first + j * kAround + (i + 1) % kAround;
      triangle(here, next, next + kAround);
      triangle(here, next + kAround, here + kAround);
    }
  }
  end_part();
  return *this;
}

MeshBuilder& MeshBuilder::bar(std::span<const Eigen::Vector3d> points, double radius_m) {
  constexpr int kSides = 8;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    frustum(points[i], points[i + 1], radius_m, radius_m, true, kSides);
  return *this;
}

MeshBuilder& MeshBuilder::ring(const Eigen::Vector3d& centre,
                               double inner_radius_m,
                               double outer_radius_m) {
  return frustum(
      centre, centre + Eigen::Vector3d(0.0, 0.0, 1e-6), inner_radius_m, outer_radius_m, false);
}

MeshBuilder& MeshBuilder::sheet(std::span<const Eigen::Vector3d> points) {
  begin_part();
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (const Eigen::Vector3d& point : points) vertex(point);
  for (std::uint32_t i = 1; i + 1 < points.size(); ++i) triangle(first, first + i, first + i + 1);
  end_part();
  return *this;
}

MeshBuilder& MeshBuilder::leaf(const Eigen::Vector3d& stem,
                               const Eigen::Vector3d& tip,
                               double width_m) {
  const Eigen::Vector3d along = tip - stem;
  const Eigen::Vector3d side =
      0.5 * width_m * Eigen::Vector3d(-along.y(), along.x(), 0.0).normalized();
  const Eigen::Vector3d bulge{0.0, 0.0, 0.25 * along.norm()};
  const Eigen::Vector3d middle = stem + 0.5 * along + bulge;
  const Eigen::Vector3d near = stem + 0.2 * along + 0.6 * bulge;
  const Eigen::Vector3d left = middle + side;
  const Eigen::Vector3d right = middle - side;
  const Eigen::Vector3d near_left = near + 0.6 * side;
  const Eigen::Vector3d near_right = near - 0.6 * side;
  sheet(std::array{stem, near_left, left, right, near_right});
  return sheet(std::array{tip, left, right});
}

TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& motion) {
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (motion * vertex.cast<double>()).cast<float>();
  return mesh;
}

Box bounds(const TriangleMesh& mesh) {
  return bounding_box(mesh.vertices);
}

}  // namespace hypermap
