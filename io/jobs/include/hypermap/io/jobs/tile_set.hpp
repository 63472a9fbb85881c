// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A set of archives with an index, as `run_split` writes it: a map of which only the parts that a
/// question needs are loaded.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/split_job.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace hypermap {

struct TileSet {
  std::filesystem::path folder = {};
  double edge_m = 0.0;
  std::vector<MapTile> tiles = {};
  std::vector<TileWay> ways = {};
};

/// Whether `path` is such a folder, or the index in one: by the index's name alone.
[[nodiscard]] bool is_tile_set(const std::filesystem::path& path);

/// The text of the file `index`. Errors: those of read_tile_set but of reading.
[[nodiscard]] Result<TileSet> parse_tile_set(std::string_view text,
                                             const std::filesystem::path& index);

/// The index of a folder, or one that is named itself. No archive is opened.
/// Errors: kIo; kLimit for an index of more than 16 MiB; kMalformedFile naming line and JSON path:
/// no tiles, an area that is not finite or has no inside, a tile that stands twice, a file that is
/// no name of an archive in the folder, a way of vertices that the tiles do not have.
[[nodiscard]] Result<TileSet> read_tile_set(const std::filesystem::path& path);

/// The tiles that `asked` reaches, edges included; all without it. Indices of `tiles`, ascending.
[[nodiscard]] std::vector<std::size_t> tiles_reached(const TileSet& set,
                                                     const std::optional<Rect>& asked);

/// The map of some tiles (`joined`), with those parts of it that are asked for. Its topological map
/// has the vertices and ways of the whole map that are in these tiles and between them, where the
/// index tells of them; where tiles are missing, also support vertices of objects whose own place
/// is in those.
/// Boundary: no tiles are asked, the first one stands for what all have: classes, frames, runs.
/// Errors: those of load_archive_parts and joined; `file` names the tile.
/// Cost: that of the tiles that are asked, which are held at once.
[[nodiscard]] Result<Loaded<PartialMap>> load_tiles(const TileSet& set,
                                                    const std::vector<std::size_t>& asked,
                                                    const ArchiveParts& parts,
                                                    const ArchiveLimits& limits = {},
                                                    const StopCheck& stop = {});

}  // namespace hypermap
