// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/asked_cells.hpp"

namespace hypermap {

void for_each_asked_cell(const GridGeometry& geometry,
                         const LayerQuery& query,
                         const CellVisitor& visit) {
  const auto at = query.at ? cell_at(geometry, query.at->xy) : std::nullopt;
  if (query.at && !at) return;
  if (query.area) {
    for_each_covered_cell(geometry, *query.area, [&](Cell cell, double /*covered*/) {
      if (!at || cell == *at) visit(cell);
    });
    return;
  }
  if (at) return visit(*at);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) visit(Cell{col, row});
  }
}

}  // namespace hypermap
