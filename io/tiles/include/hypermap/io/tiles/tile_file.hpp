// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A tile as a file.
///
/// A zip with the member `tile.json`, which tells content, resolution and location at full
/// precision, and a member for each layer, `layer-0` and so on: log-odds in steps of 0.001 as
/// 16-bit integers, little-endian, row-major from the smallest y. Zip gives what a file of ours
/// needs: a checksum for each layer, compression (a tile is mostly unknown), a reader that was made
/// for strangers' files, and programs everywhere that open it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/projection/tiles/tile_lattice.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {

/// The largest file of a tile, and of its layers together.
inline constexpr std::uint64_t kMaxTileBytes = std::uint64_t{1} << 30;

/// A tile, and of which lattice it is one.
struct FiledTile {
  TileLattice lattice;
  StackTile tile;
  friend bool operator==(const FiledTile&, const FiledTile&) = default;
};

/// The name of a tile's file: `tile_<col>_<row>_logodds_<resolution>m_at_<x>m_<y>m.tile` with its
/// index and its lower-left corner; numbers read back equal.
/// Errors: those of geometry_of.
[[nodiscard]] Result<std::string> tile_file_name(const TileLattice& lattice, TileIndex index);

/// The same bytes for the same tile.
/// Errors: those of validate(TileLattice) and validate(StackTile); kInvalidArgument for a name that
/// is no UTF-8; kLimit for more than 256 layers, or beyond kMaxTileBytes; kOutOfMemory.
[[nodiscard]] Result<std::string> encode_tile(const StackTile& tile, const TileLattice& lattice);

/// Errors: kMalformedFile with member and field; kUnsupported for one that a newer version wrote;
/// kLimit as encode_tile, before memory is taken; kOutOfMemory.
[[nodiscard]] Result<FiledTile> decode_tile(std::string_view bytes, const SourceName& source);

/// Errors: also kIo.
[[nodiscard]] Result<FiledTile> read_tile_file(const std::filesystem::path& path);

}  // namespace hypermap
