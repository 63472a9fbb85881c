// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where each class is in a map that has no class grids: from the shapes of its semantic layer.
///
/// Source: [smap] F.6 (2D representation for a class, figure F.6.10).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <string>
#include <vector>

namespace hypermap {

struct FootprintGrids {
  std::string layer;             ///< Whose shapes they are.
  std::vector<ClassGrid> grids;  ///< One for each name in it, ascending by name.
};

/// 100 where a shape of the class meets the cell, so that nothing small is lost; else -1 where the
/// map's first occupancy grid in the layer's frame knows nothing, and 0 where it does, obstacles
/// included: they are no objects of the class. The cells are those of that grid, continued to hold
/// all shapes; without one they have edges of 5 cm, unturned, and are unknown where no shape is.
///
/// Errors: kNotFound when the map has no semantic layer; kLimit for a grid that is too large or
/// more than 2^30 cells in all. Boundary: a layer without objects gives no grids.
[[nodiscard]] Result<FootprintGrids> footprint_grids(const MapArchive& archive);

}  // namespace hypermap
