// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_folder.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/tiles/tile_file.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTileEnding = ".tile";
constexpr std::string_view kTileStart = "tile_";

Unexpected folder_error(ErrorCode code, std::string what, const fs::path& path) {
  return Unexpected(Error{.code = code, .what = std::move(what), .file = path.string()});
}

/// A whole number at the start of the text, with the sign that follows it; the text goes on behind.
std::optional<std::int32_t> take_number(std::string_view& text) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end == text.data() + text.size() || *end != '_') return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return number;
}

/// The tile that a file of this name holds; none when it is not called as one.
std::optional<TileIndex> index_in(const std::string& name, const TileLattice& lattice) {
  std::string_view rest = name;
  if (!rest.starts_with(kTileStart)) return std::nullopt;
  rest.remove_prefix(kTileStart.size());
  const auto col = take_number(rest);
  const auto row = take_number(rest);
  if (!col || !row) return std::nullopt;
  const TileIndex index{*col, *row};
  const auto expected = tile_file_name(lattice, index);
  return expected && *expected == name ? std::optional(index) : std::nullopt;
}

std::string text_of(const TileLattice& lattice) {
  return std::to_string(lattice.tile_cells) + " cells of " + number_text(lattice.resolution_m) +
         " m in frame '" + printable(lattice.frame_id) + "'";
}

Result<void> check_lattice(const TileLattice& found,
                           const TileLattice& expected,
                           ErrorCode code,
                           const fs::path& path) {
  if (found == expected) return {};
  return folder_error(
      code, "holds tiles of " + text_of(found) + ", expected " + text_of(expected), path);
}

/// What a misnamed file must be called; nothing when its content does not say it.
std::string expected_name_text(const std::filesystem::path& path) {
  const auto filed = read_tile_file(path);
  if (!filed) return "";
  const auto name = tile_file_name(filed->lattice, filed->tile.index);
  return name ? ", by its content it must be called " + printable(*name, name->size()) : "";
}

}  // namespace

Result<std::vector<std::string>> files_in(const fs::path& folder, std::string_view ending) {
  return guarded(ErrorCode::kIo, "the folder", [&]() -> Result<std::vector<std::string>> {
    std::error_code failed;
    fs::directory_iterator entries(folder, failed);
    std::vector<std::string> names;
    while (!failed && entries != fs::directory_iterator()) {
      std::string name = entries->path().filename().string();
      std::error_code vanished;  // temporaries of a writer come and go
      if (name.ends_with(ending) && entries->is_regular_file(vanished)) {
        names.push_back(std::move(name));
      }
      entries.increment(failed);
    }
    if (failed) return folder_error(ErrorCode::kIo, "cannot list: " + failed.message(), folder);
    std::ranges::sort(names);
    return names;
  });
}

Result<TileFolder> TileFolder::create(const fs::path& path, TileLattice lattice) {
  HYPERMAP_TRY(validate(lattice));
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed) return folder_error(ErrorCode::kIo, "cannot make it: " + failed.message(), path);
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, files_in(path, kTileEnding));
  if (!names.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const FiledTile first, read_tile_file(path / names.front()));
    HYPERMAP_TRY(check_lattice(first.lattice, lattice, ErrorCode::kInvalidArgument, path));
  }
  return TileFolder(path, std::move(lattice));
}

Result<TileFolder> TileFolder::open(const fs::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, files_in(path, kTileEnding));
  if (names.empty()) return folder_error(ErrorCode::kNotFound, "has no tiles", path);
  HYPERMAP_ASSIGN_OR_RETURN(FiledTile first, read_tile_file(path / names.front()));
  return TileFolder(path, std::move(first.lattice));
}

Result<void> TileFolder::put(const StackTile& tile) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_tile(tile, lattice_));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string name, tile_file_name(lattice_, tile.index));
  return write_file_atomically(path_ / name, bytes);
}

Result<std::optional<StackTile>> TileFolder::get(TileIndex index) const {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string name, tile_file_name(lattice_, index));
  const fs::path file = path_ / name;
  std::error_code failed;
  const bool is_there = fs::exists(file, failed);
  if (failed) return folder_error(ErrorCode::kIo, "cannot look: " + failed.message(), file);
  if (!is_there) return std::optional<StackTile>();
  HYPERMAP_ASSIGN_OR_RETURN(FiledTile filed, read_tile_file(file));
  HYPERMAP_TRY(check_lattice(filed.lattice, lattice_, ErrorCode::kMalformedFile, file));
  if (filed.tile.index != index) {
    return folder_error(ErrorCode::kMalformedFile,
                        "holds tile " + std::to_string(filed.tile.index.col) + ", " +
                            std::to_string(filed.tile.index.row) + ", not that of its name",
                        file);
  }
  return std::optional(std::move(filed.tile));
}

Result<std::vector<TileIndex>> TileFolder::list() const {
  HYPERMAP_ASSIGN_OR_RETURN(const auto names, files_in(path_, kTileEnding));
  std::vector<TileIndex> tiles;
  tiles.reserve(names.size());
  for (const std::string& name : names) {
    const auto index = index_in(name, lattice_);
    if (!index) {
      return folder_error(
          ErrorCode::kMalformedFile,
          "is not called as a tile of " + text_of(lattice_) + expected_name_text(path_ / name),
          path_ / name);
    }
    tiles.push_back(*index);
  }
  std::ranges::sort(tiles);
  return tiles;
}

}  // namespace hypermap
