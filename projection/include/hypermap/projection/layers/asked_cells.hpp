// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells of a grid a query looks at: what layers made of cells share.
///
/// Source: [hypermap] 3.3.3 (spatial queries of grids).
#pragma once

#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/layers/layer_query.hpp"

#include <functional>

namespace hypermap {

using CellVisitor = std::function<void(Cell)>;

/// Visits the cells that hold `query.at` and share area with `query.area`, all where neither is
/// asked, in row-major order; what text and value ask is left to the visitor. Boundary: none for a
/// point outside the grid, nor of a grid without cells. Cost: of for_each_covered_cell; O(1) for a
/// point alone.
void for_each_asked_cell(const GridGeometry& geometry,
                         const LayerQuery& query,
                         const CellVisitor& visit);

}  // namespace hypermap
