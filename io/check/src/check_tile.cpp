// SPDX-License-Identifier: BSD-3-Clause
#include "file_checks.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"
#include "hypermap/io/tiles/tile_file.hpp"

#include <string>

namespace hypermap {
namespace {

std::string tile_text(const GridGeometry& geometry, std::size_t num_layers) {
  return "tile of " + std::to_string(geometry.cols) + " x " + std::to_string(geometry.rows) +
         " cells of " + number_text(geometry.resolution_m) + " m, " +
         count_text(num_layers, "layer");
}

}  // namespace

Result<FileSummary> check_tile(const std::filesystem::path& path) {
  if (path.extension() != ".tile") {
    HYPERMAP_ASSIGN_OR_RETURN(const SogmTile tile, read_sogm_tile(path));
    return FileSummary{tile_text(tile.grid.geometry(), 1), {}};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const FiledTile filed, read_tile_file(path));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            geometry_of(filed.lattice, {.first = filed.tile.index}));
  return FileSummary{tile_text(geometry, filed.tile.layers.size()), {}};
}

}  // namespace hypermap
