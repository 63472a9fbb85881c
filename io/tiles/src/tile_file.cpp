// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_file.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "tile_head.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kHeadName = "tile.json";
constexpr std::string_view kNoArchive = "not a map archive";
constexpr std::size_t kMaxLayers = 256;

constexpr ZipLimits kTileLimits{.max_archive_bytes = kMaxTileBytes,
                                .max_entries = kMaxLayers + 1,
                                .max_entry_bytes = kMaxTileBytes,
                                .max_total_bytes = kMaxTileBytes};

std::string layer_member(std::size_t place) {
  return "layer-" + std::to_string(place);
}

std::string cell_bytes(const LogOddsGrid& grid) {
  std::string bytes;
  bytes.reserve(2 * grid.cells().size());
  for (const LogOddsSteps steps : grid.cells()) {
    const auto bits = static_cast<std::uint16_t>(steps);
    bytes.push_back(static_cast<char>(bits & 0xFFU));
    bytes.push_back(static_cast<char>(bits >> 8U));
  }
  return bytes;
}

/// Requires: two bytes for each cell.
Result<LogOddsGrid> cells_from(std::string_view bytes, const GridGeometry& geometry) {
  std::vector<LogOddsSteps> cells;
  cells.reserve(geometry.num_cells());
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const auto low = static_cast<std::uint8_t>(bytes[i]);
    const auto high = static_cast<std::uint8_t>(bytes[i + 1]);
    cells.push_back(static_cast<LogOddsSteps>(low | (high << 8U)));
  }
  return LogOddsGrid::create(geometry, std::move(cells));
}

/// `text` as it is written must be what is read again.
Result<void> check_text(std::string_view text, const char* field) {
  if (printable(text, text.size()) == text) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be UTF-8 without control characters, is '" + printable(text) + "'",
              field);
}

Result<void> check_names(const StackTile& tile, const TileLattice& lattice) {
  HYPERMAP_TRY(check_text(lattice.frame_id, "frame_id"));
  for (const auto& [name, grid] : tile.layers) HYPERMAP_TRY(check_text(name, "layers"));
  if (tile.layers.size() <= kMaxLayers) return {};
  return fail(ErrorCode::kLimit,
              std::to_string(tile.layers.size()) + " layers, the limit is 256",
              "layers");
}

/// The members that the head calls for, each of the tile's cells, and no others.
Result<void> check_members(const ZipReader& zip, const TileHead& head) {
  if (zip.members().size() != head.layers.size() + 1) {
    return fail(ErrorCode::kMalformedFile,
                std::to_string(zip.members().size()) + " members, expected tile.json and " +
                    std::to_string(head.layers.size()) + " layers");
  }
  const std::uint64_t side = static_cast<std::uint64_t>(head.lattice.tile_cells);
  for (std::size_t i = 0; i < head.layers.size(); ++i) {
    const ZipMember* member = zip.find(layer_member(i));
    if (member != nullptr && member->num_bytes == 2 * side * side) continue;
    Error wrong{
        .code = ErrorCode::kMalformedFile,
        .what = "must have 2 x " + std::to_string(side) + " x " + std::to_string(side) +
                " bytes, " +
                (member == nullptr ? "is missing" : "has " + std::to_string(member->num_bytes)),
        .entry = layer_member(i)};
    return Unexpected(std::move(wrong));
  }
  return {};
}

Result<FiledTile> read_tile(const ZipReader& zip) {
  const auto in_entry = [](Error error, const std::string& entry) {
    return Unexpected(with_source(std::move(error), {.file = {}, .entry = entry}));
  };
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text,
                            zip.read(std::string(kHeadName), kMaxTileHeadBytes));
  auto head = parse_tile_head(text);
  if (!head) return in_entry(std::move(head).error(), std::string(kHeadName));
  HYPERMAP_TRY(check_members(zip, *head));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            geometry_of(head->lattice, {.first = head->index}));
  FiledTile filed{.lattice = head->lattice,
                  .tile = {.index = head->index, .layers = {}, .datum = head->datum}};
  for (std::size_t i = 0; i < head->layers.size(); ++i) {
    const std::string entry = layer_member(i);
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, zip.read(entry));
    auto grid = cells_from(bytes, geometry);
    if (!grid) {
      grid.error().code = ErrorCode::kMalformedFile;
      return in_entry(std::move(grid).error(), entry);
    }
    const bool is_new = filed.tile.layers.emplace(head->layers[i], std::move(*grid)).second;
    if (is_new) continue;
    return in_entry({.code = ErrorCode::kMalformedFile,
                     .what = "two layers are called '" + printable(head->layers[i]) + "'"},
                    std::string(kHeadName));
  }
  // What was read can be written, so that a map that was loaded can be stored.
  auto names = check_names(filed.tile, filed.lattice);
  if (names) return filed;
  if (names.error().code == ErrorCode::kInvalidArgument) {
    names.error().code = ErrorCode::kMalformedFile;
  }
  return in_entry(std::move(names).error(), std::string(kHeadName));
}

}  // namespace

Result<std::string> tile_file_name(const TileLattice& lattice, TileIndex index) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of(lattice, {.first = index}));
  return "tile_" + std::to_string(index.col) + "_" + std::to_string(index.row) + "_logodds_" +
         number_text(lattice.resolution_m) + "m_at_" + number_text(geometry.origin.x()) + "m_" +
         number_text(geometry.origin.y()) + "m.tile";
}

Result<std::string> encode_tile(const StackTile& tile, const TileLattice& lattice) {
  HYPERMAP_TRY(validate(lattice));
  HYPERMAP_TRY(validate(tile, lattice));
  HYPERMAP_TRY(check_names(tile, lattice));
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            geometry_of(lattice, {.first = tile.index}));
  return guarded(ErrorCode::kInvalidArgument, "the tile", [&]() -> Result<std::string> {
    ZipWriter zip(kTileLimits);
    HYPERMAP_TRY(zip.add(kHeadName, tile_head_json(tile, lattice, geometry)));
    std::size_t place = 0;
    for (const auto& [name, grid] : tile.layers) {
      HYPERMAP_TRY(zip.add(layer_member(place++), cell_bytes(grid)));
    }
    return zip.finish();
  });
}

Result<FiledTile> decode_tile(std::string_view bytes, const SourceName& source) {
  auto filed = guarded(ErrorCode::kMalformedFile, "the tile", [&]() -> Result<FiledTile> {
    HYPERMAP_ASSIGN_OR_RETURN(const ZipReader zip,
                              ZipReader::create(view_bytes(bytes), kTileLimits));
    return read_tile(zip);
  });
  if (filed) return filed;
  std::string& what = filed.error().what;  // archives and tiles are zips by one reader
  if (what.starts_with(kNoArchive)) what.replace(0, kNoArchive.size(), "not a tile");
  return Unexpected(with_source(std::move(filed).error(), source));
}

Result<FiledTile> read_tile_file(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, kMaxTileBytes));
  return decode_tile(bytes, {path.string()});
}

}  // namespace hypermap
