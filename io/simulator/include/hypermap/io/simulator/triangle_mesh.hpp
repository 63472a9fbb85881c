// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Solid shapes made of triangles, and what they cover seen from above.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// How a surface is coloured beyond its plain colour, as a function of the point on it.
enum class SurfacePattern : std::uint8_t {
  kPlain,   ///< A faint grain.
  kWood,    ///< Long streaks along x of the shape.
  kTiles,   ///< Square tiles of 0.5 m with dark joints.
  kFabric,  ///< A fine weave.
  kKeys,    ///< A grid of keys of 19 mm.
  kScreen,  ///< A glowing desktop with windows.
  kNotes,   ///< A white sheet with coloured lines.
  kBrick,   ///< Staggered courses.
};

struct SurfaceMaterial {
  Rgb8 color{200, 200, 200};
  SurfacePattern pattern = SurfacePattern::kPlain;
  friend bool operator==(const SurfaceMaterial&, const SurfaceMaterial&) = default;
};

/// Triangles with a material each, and the convex parts that they were built from.
///
/// Surfaces have two sides; nothing depends on the order of a triangle's corners. Unit: metre.
struct TriangleMesh {
  /// A convex part: the vertices first .. first + count - 1.
  struct Part {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  std::vector<Eigen::Vector3f> vertices = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  std::vector<std::uint16_t> material_of_triangle = {};  ///< Index into `materials`.
  std::vector<SurfaceMaterial> materials = {};
  std::vector<Part> parts = {};
};

/// Builds a mesh from simple solids. Each solid is one convex part of the footprint.
///
/// Sizes are the caller's duty: zero or negative extents give degenerate triangles, which no ray
/// hits.
class MeshBuilder {
 public:
  /// Solids added from now on have this material.
  MeshBuilder& material(SurfaceMaterial material);
  /// Solids added from now on are moved by this transform (from the solid's frame to the mesh's).
  MeshBuilder& placed(const Eigen::Isometry3d& mesh_from_solid);

  /// A cuboid from corner to corner.
  MeshBuilder& box(const Eigen::Vector3d& min, const Eigen::Vector3d& max);
  /// A cylinder or cone frustum between two points; open ends have no cap.
  MeshBuilder& frustum(const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to,
                       double radius_from_m,
                       double radius_to_m,
                       bool capped = true,
                       int num_sides = 20);
  /// An ellipsoid, or with `upper_half` only its part above the centre.
  MeshBuilder& ellipsoid(const Eigen::Vector3d& centre,
                         const Eigen::Vector3d& radii,
                         bool upper_half = false);
  /// A round bar along a line of points.
  MeshBuilder& bar(std::span<const Eigen::Vector3d> points, double radius_m);
  /// A flat ring between two radii, normal along z.
  MeshBuilder& ring(const Eigen::Vector3d& centre, double inner_radius_m, double outer_radius_m);
  /// A thin convex surface, a fan of triangles around its first point.
  MeshBuilder& sheet(std::span<const Eigen::Vector3d> points);
  /// A pointed leaf from stem to tip, bent down at its end.
  MeshBuilder& leaf(const Eigen::Vector3d& stem, const Eigen::Vector3d& tip, double width_m);

  /// What was added so far.
  [[nodiscard]] TriangleMesh build() const { return mesh_; }

 private:
  std::uint32_t vertex(const Eigen::Vector3d& in_solid);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void begin_part();
  void end_part();

  TriangleMesh mesh_;
  std::uint16_t material_ = 0;
  Eigen::Isometry3d mesh_from_solid_ = Eigen::Isometry3d::Identity();
};

/// The mesh moved by a rigid motion.
[[nodiscard]] TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& motion);

/// The smallest box around all vertices. Requires: a mesh with vertices.
[[nodiscard]] Box bounds(const TriangleMesh& mesh);

/// What the mesh covers seen from above: the union of its parts, without the holes that it
/// encloses.
///
/// When the union falls into several pieces (legs of a chair without a seat), the convex hull of
/// all. Unit: metre; coordinates are snapped to 0.1 mm, so that the union is robust. Errors:
/// kInvalidArgument when the mesh covers no area.
[[nodiscard]] Result<Polygon> footprint(const TriangleMesh& mesh);

}  // namespace hypermap
