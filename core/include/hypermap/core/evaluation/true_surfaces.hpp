// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The surfaces of the true objects as triangles, and what of them a camera has seen.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/triangle.hpp"

#include <Eigen/Geometry>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// A cube of a lattice through the origin of the map: it covers [x, x + 1) edges along x, and so
/// on.
struct SurfaceCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  friend auto operator<=>(const SurfaceCell&, const SurfaceCell&) = default;
};

/// The surface of one true object. Frame: that of the truth. Unit: metre.
struct TrueSurface {
  ObjectId id = kNoObject;
  std::string class_name = {};
  bool is_nameable = true;  ///< The detector has a word for the class.
  std::vector<Eigen::Vector3f> vertices = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  std::vector<SurfaceCell> seen_cells = {};  ///< That a measured pixel of it lay in, ascending.
  friend bool operator==(const TrueSurface&, const TrueSurface&) = default;
};

struct TrueSurfaces {
  double seen_cell_m = 0.05;              ///< Edge of the cells of `seen_cells`.
  std::vector<TrueSurface> objects = {};  ///< In ascending order of ids.
  friend bool operator==(const TrueSurfaces&, const TrueSurfaces&) = default;
};

/// Requires: index < surface.triangles.size(), a valid surface.
[[nodiscard]] Triangle triangle_at(const TrueSurface& surface, std::size_t index);
/// The middle of a cell of lattice edge `edge_m`.
[[nodiscard]] Eigen::Vector3d centre_of(const SurfaceCell& cell, double edge_m);
/// The cell that holds a point; a point on a face belongs to the upper one.
/// Requires: coordinates within 2^31 edges of the origin.
[[nodiscard]] SurfaceCell cell_of(const Eigen::Vector3d& point, double edge_m);

/// The surfaces moved by a rigid motion; seen cells go to the cells where their centres then lie,
/// and cells that meet are one. Requires: what is moved stays within 1e6 m.
[[nodiscard]] TrueSurfaces transformed(TrueSurfaces surfaces, const Eigen::Isometry3d& motion);

/// Errors: kInvalidArgument naming the field: an edge outside 0.001 .. 10 m; ids that are 0 or not
/// ascending; no class name; a vertex that is not finite or beyond 1e6 m; a triangle with a vertex
/// that is not there; cells that are not ascending or lie beyond 1e6 m.
[[nodiscard]] Result<void> validate(const TrueSurfaces& surfaces);

}  // namespace hypermap
