// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The member `tile.json` of a tile's file: content, resolution and location.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/tiles/geographic_datum.hpp"
#include "hypermap/projection/tiles/tile_lattice.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

inline constexpr std::size_t kMaxTileHeadBytes = std::size_t{1} << 20U;

/// What it says.
struct TileHead {
  TileLattice lattice;
  TileIndex index;
  std::optional<GeographicDatum> datum;
  std::vector<std::string> layers;  ///< By the number of their member.
};

/// Requires: `geometry` is that of the tile.
[[nodiscard]] std::string tile_head_json(const StackTile& tile,
                                         const TileLattice& lattice,
                                         const GridGeometry& geometry);

/// Errors: kMalformedFile with line and path; kUnsupported for a newer version, or other content.
[[nodiscard]] Result<TileHead> parse_tile_head(std::string_view text);

}  // namespace hypermap
