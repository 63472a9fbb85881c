// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map as a set of archives, one for each square of the plane.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/cropped_map.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Of a set of tiles, in its folder.
inline constexpr std::string_view kTileIndexName = "tiles.json";

struct SplitJob {
  double edge_m = 10.0;  ///< Of the squares, with corners at its multiples.
  std::filesystem::path output = {};
  ArchiveLimits limits = {};
};

/// One archive of the set.
struct MapTile {
  std::string file;  ///< "tile_<column>_<row>.hmap", numbers of edges from the origin.
  Rect area;         ///< Half open, in frame `map`.
  Rect reach;        ///< The same with all of its objects and shapes, which may jut out of it.
  std::size_t num_voxels = 0;
  std::size_t num_objects = 0;
  /// Of the map's topological map, the first ones of the tile's; none: nobody says.
  std::optional<std::size_t> num_vertices = std::nullopt;
};

/// A vertex by its tile's place in the list and its own among the tile's.
struct TileVertex {
  std::size_t tile = 0;
  std::size_t number = 0;
  friend bool operator==(const TileVertex&, const TileVertex&) = default;
};

/// An edge of the topological map from one tile to another.
struct TileWay {
  TileVertex from = {};
  TileVertex to = {};
  friend bool operator==(const TileWay&, const TileWay&) = default;
};

struct SplitReport {
  std::vector<MapTile> tiles;         ///< By rows from the lowest, columns ascending.
  std::vector<std::string> left_out;  ///< What no tile has, by name (see `cropped`).
  std::vector<TileWay> ways;
};

/// Writes a folder with an archive for each tile that has something (`map_tiles`, `cropped`) and
/// `tiles.json`, which says what lies where: `tile_m`, `tiles` [{`file`, `area` [x, y, x, y],
/// `reach` likewise, `voxels`, `objects`, `vertices`}], `ways` [[tile, vertex, tile, vertex]];
/// tile_set.hpp reads it. The folder appears whole or not
/// at all.
///
/// Errors: those of map_tiles, cropped and write_archive; kInvalidArgument for a folder that holds
/// anything but such files; kIo; kInterrupted when progress, which counts tiles, says so.
/// Cost: the map is looked at once for each tile.
[[nodiscard]] Result<SplitReport> run_split(const MapArchive& archive,
                                            const SplitJob& job,
                                            const JobProgress& progress = {});

}  // namespace hypermap
