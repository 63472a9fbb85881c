// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_file.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_writer.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kHeadName = "tile.json";
constexpr std::string_view kFormat = "hypermap tile";
constexpr std::string_view kContent = "log-odds";
constexpr std::int64_t kVersion = 1;
constexpr std::size_t kMaxLayers = 256;
constexpr std::size_t kMaxHeadBytes = std::size_t{1} << 20U;

constexpr ZipLimits kTileLimits{.max_archive_bytes = kMaxTileBytes,
                                .max_entries = kMaxLayers + 1,
                                .max_entry_bytes = kMaxTileBytes,
                                .max_total_bytes = kMaxTileBytes};

/// What `tile.json` says.
struct TileHead {
  TileLattice lattice;
  TileIndex index;
  std::optional<GeographicDatum> datum;
  std::vector<std::string> layers;
};

std::string layer_member(std::size_t place) {
  return "layer-" + std::to_string(place);
}

std::string datum_json(const std::optional<GeographicDatum>& datum) {
  if (!datum) return "null";
  return json_object({{"latitude_deg", json_number(datum->latitude_deg)},
                      {"longitude_deg", json_number(datum->longitude_deg)},
                      {"altitude_m", json_number(datum->altitude_m)},
                      {"yaw_rad", json_number(datum->yaw_rad)}});
}

std::string head_json(const StackTile& tile,
                      const TileLattice& lattice,
                      const GridGeometry& geometry) {
  const auto name_json = [](const auto& layer) { return json_quoted(layer.first); };
  return json_object({{"format", json_quoted(kFormat)},
                      {"version", std::to_string(kVersion)},
                      {"content", json_quoted(kContent)},
                      {"frame_id", json_quoted(lattice.frame_id)},
                      {"resolution_m", json_number(lattice.resolution_m)},
                      {"tile_cells", std::to_string(lattice.tile_cells)},
                      {"col", std::to_string(tile.index.col)},
                      {"row", std::to_string(tile.index.row)},
                      {"x_m", json_number(geometry.origin.x())},
                      {"y_m", json_number(geometry.origin.y())},
                      {"datum", datum_json(tile.datum)},
                      {"layers", json_array(tile.layers, name_json)}}) +
         "\n";
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

Result<std::string> string_at(const JsonNode& object, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
  return std::string(text);
}

Result<void> check_format(const JsonNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string format, string_at(root, "format"));
  if (format != kFormat) {
    return root.error(ErrorCode::kMalformedFile, "format must be '" + std::string(kFormat) + "'");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, root.require("version"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t version, node.integer(1, 1'000'000));
  if (version <= kVersion) return {};
  return node.error(ErrorCode::kUnsupported,
                    "written by a newer version " + std::to_string(version) + ", expected " +
                        std::to_string(kVersion));
}

Result<std::optional<GeographicDatum>> datum_of(const JsonNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, root.require("datum"));
  if (node.is(JsonKind::kNull)) return std::optional<GeographicDatum>();
  HYPERMAP_TRY(expect_keys(node, {"latitude_deg", "longitude_deg", "altitude_m", "yaw_rad"}));
  GeographicDatum datum;
  HYPERMAP_ASSIGN_OR_RETURN(datum.latitude_deg, number_at(node, "latitude_deg"));
  HYPERMAP_ASSIGN_OR_RETURN(datum.longitude_deg, number_at(node, "longitude_deg"));
  HYPERMAP_ASSIGN_OR_RETURN(datum.altitude_m, number_at(node, "altitude_m"));
  HYPERMAP_ASSIGN_OR_RETURN(datum.yaw_rad, number_at(node, "yaw_rad"));
  return std::optional(datum);
}

Result<std::vector<std::string>> layers_of(const JsonNode& root) {
  return list_at(root, "layers", [](const JsonNode& node) -> Result<std::string> {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, node.string());
    return std::string(name);
  });
}

/// Where the tile lies is told twice, for those who read the numbers and for those who count cells.
Result<void> check_place(const JsonNode& root, const TileHead& head) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            validated(root, geometry_of(head.lattice, {.first = head.index})));
  HYPERMAP_ASSIGN_OR_RETURN(const double x_m, number_at(root, "x_m"));
  HYPERMAP_ASSIGN_OR_RETURN(const double y_m, number_at(root, "y_m"));
  const Eigen::Vector2d& origin = geometry.origin;
  if (x_m == origin.x() && y_m == origin.y()) return {};
  return root.error(ErrorCode::kMalformedFile,
                    "x_m and y_m must be " + number_text(origin.x()) + " and " +
                        number_text(origin.y()) + " by col and row, are " + number_text(x_m) +
                        " and " + number_text(y_m));
}

Result<TileHead> parse_head(std::string_view text) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const JsonDocument document,
      JsonDocument::parse(text, {}, {.max_bytes = kMaxHeadBytes, .max_depth = 4}));
  const JsonNode root = document.root();
  HYPERMAP_TRY(check_format(root));
  HYPERMAP_TRY(expect_keys(root,
                           {"format",
                            "version",
                            "content",
                            "frame_id",
                            "resolution_m",
                            "tile_cells",
                            "col",
                            "row",
                            "x_m",
                            "y_m",
                            "datum",
                            "layers"}));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string content, string_at(root, "content"));
  if (content != kContent) {
    return root.error(
        ErrorCode::kUnsupported,
        "content must be '" + std::string(kContent) + "', is '" + printable(content) + "'");
  }
  TileHead head;
  HYPERMAP_ASSIGN_OR_RETURN(head.lattice.frame_id, string_at(root, "frame_id"));
  HYPERMAP_ASSIGN_OR_RETURN(head.lattice.resolution_m, number_at(root, "resolution_m"));
  HYPERMAP_ASSIGN_OR_RETURN(head.lattice.tile_cells, integer_at<int>(root, "tile_cells"));
  HYPERMAP_ASSIGN_OR_RETURN(head.index.col, integer_at<std::int32_t>(root, "col"));
  HYPERMAP_ASSIGN_OR_RETURN(head.index.row, integer_at<std::int32_t>(root, "row"));
  HYPERMAP_ASSIGN_OR_RETURN(head.datum, datum_of(root));
  HYPERMAP_ASSIGN_OR_RETURN(head.layers, layers_of(root));
  HYPERMAP_TRY(validated(root, validate(head.lattice)));
  if (head.datum) HYPERMAP_TRY(validated(root, validate(*head.datum)));
  HYPERMAP_TRY(check_place(root, head));
  return head;
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
                            zip.read(std::string(kHeadName), kMaxHeadBytes));
  auto head = parse_head(text);
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
    HYPERMAP_TRY(zip.add(kHeadName, head_json(tile, lattice, geometry)));
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
  if (!filed) return Unexpected(with_source(std::move(filed).error(), source));
  return filed;
}

}  // namespace hypermap
