// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where each class is: a grid per class, from the 3D map or from shapes.
///
/// Source: [smap] appendix F.6, map exporter. Deviation: it covers the corners' square with
/// Bresenham lines; here polygons are filled, whatever the grid's yaw.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// 100 where an occupied leaf of the class stands in the column, 0 where the column holds other
/// objects or is free, -1 where it is unknown.
struct ClassColumns {
  ClassId id;
  OccupancyGrid grid;
};

/// A grid for each class that some occupied leaf in the band bears, by ascending id, all of one
/// geometry: that of project_occupancy with the same band and options, unknown where it is unknown.
/// Voxels alone decide: a cleared seat is no cell of its class.
/// Errors: as project_occupancy; kLimit when all grids together have more than 2^30 cells.
[[nodiscard]] Result<std::vector<ClassColumns>> project_class_grids(
    const LeafSource& leaves,
    const HeightBand& band = {},
    const OccupancyProjectionOptions& options = {});

/// 100 where shapes cover at least `min_covered` of a cell, 0 elsewhere. With 0 every cell that a
/// shape meets counts, so that nothing small is lost.
/// Errors: those of OccupancyGrid::create; kInvalidArgument when min_covered is outside [0, 1].
[[nodiscard]] Result<OccupancyGrid> fill_shapes(const GridGeometry& geometry,
                                                std::span<const Polygon> shapes,
                                                double min_covered = 0.0);

}  // namespace hypermap
