// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Objects, shapes and grids moved in the plane and in height.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <Eigen/Geometry>

namespace hypermap {

/// A rigid motion that leaves +z up.
struct UprightMotion {
  double yaw_rad = 0.0;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Isometry3d in_space() const;
  [[nodiscard]] Eigen::Isometry2d in_plane() const;
};

/// The smallest box along the map's axes around the moved one.
[[nodiscard]] Box transformed(const Box& box, const UprightMotion& motion);

/// Errors: kInvalidArgument when rounding leaves no valid polygon.
[[nodiscard]] Result<Polygon> transformed(const Polygon& polygon, const UprightMotion& motion);
/// Boundary: a grid without cells lies nowhere and stays. Errors: as validate(GridGeometry).
[[nodiscard]] Result<OccupancyGrid> transformed(const OccupancyGrid& grid,
                                                const UprightMotion& motion);
/// Boundary: a layer without a stack stays. Errors: as validate(GridGeometry).
[[nodiscard]] Result<GridStackLayer> transformed(const GridStackLayer& layer,
                                                 const UprightMotion& motion);
/// Boundary: a layer without cells stays. Errors: as validate(GridGeometry).
[[nodiscard]] Result<SupercellLayer> transformed(const SupercellLayer& layer,
                                                 const UprightMotion& motion);
/// With the boxes that a truth has of its shapes (simulation_truth.hpp). Errors: as of polygons,
/// naming the object.
[[nodiscard]] Result<SemanticLayer> transformed(const SemanticLayer& layer,
                                                const UprightMotion& motion);
/// Errors: as of polygons, and kLimit beyond 1e6 m, naming the object.
[[nodiscard]] Result<ObjectMap> transformed(const ObjectMap& objects, const UprightMotion& motion);

/// The sensor stays where it is in it. Errors: as TopologicalMap::create beyond 1e6 m.
[[nodiscard]] Result<TopologicalMap> transformed(const TopologicalMap& map,
                                                 const UprightMotion& motion);

}  // namespace hypermap
