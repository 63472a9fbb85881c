// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tiles in a folder, a file each.
///
/// Source: [sogm] III-E (content is stored independently, tagged, to a permanent storage).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/tiles/tile_lattice.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// A store whose tiles are files (tile_file.hpp). Nothing of them stays in memory.
///
/// A file is replaced as a whole (write_file_atomically): who reads while another writes, and a
/// system that lost its power, find each tile as it was before or after. Other files in the folder
/// are left alone. Cost: `put` waits for the disk twice, for the file and for the folder; it and
/// `list` look at all names in the folder.
class TileFolder final : public TileStore {
 public:
  /// A folder for tiles of a lattice, made when it is not there.
  /// Errors: those of validate(TileLattice); kInvalidArgument when tiles of another lattice lie in
  /// it, telling what differs; those of `open` for one that cannot be read; kIo.
  [[nodiscard]] static Result<TileFolder> create(const std::filesystem::path& path,
                                                 TileLattice lattice);
  /// A folder with tiles, whose lattice is that of the first one.
  /// Errors: kNotFound when there are none; kIo; those of decode_tile.
  [[nodiscard]] static Result<TileFolder> open(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] const TileLattice& lattice() const override { return lattice_; }
  [[nodiscard]] Result<void> put(const StackTile& tile) override;
  /// Errors: also kMalformedFile when the file holds another tile than its name says, or one of
  /// another lattice.
  [[nodiscard]] Result<std::optional<StackTile>> get(TileIndex index) const override;
  /// Errors: also kMalformedFile for a file in `.tile` that is not called as a tile of the lattice:
  /// it would be missed.
  [[nodiscard]] Result<std::vector<TileIndex>> list() const override;

 private:
  TileFolder(std::filesystem::path path, TileLattice lattice)
      : path_(std::move(path)), lattice_(std::move(lattice)) {}

  std::filesystem::path path_;
  TileLattice lattice_;
};

/// Names of the regular files in a folder that end so, ascending. Errors: kIo, also when there is
/// no such folder.
[[nodiscard]] Result<std::vector<std::string>> files_in(const std::filesystem::path& folder,
                                                        std::string_view ending);

}  // namespace hypermap
