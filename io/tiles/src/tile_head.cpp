// SPDX-License-Identifier: BSD-3-Clause
#include "tile_head.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"

#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kFormat = "hypermap tile";
constexpr std::string_view kContent = "log-odds";
constexpr std::int64_t kVersion = 1;

std::string datum_json(const std::optional<GeographicDatum>& datum) {
  if (!datum) return "null";
  return json_object({{"latitude_deg", json_number(datum->latitude_deg)},
                      {"longitude_deg", json_number(datum->longitude_deg)},
                      {"altitude_m", json_number(datum->altitude_m)},
                      {"yaw_rad", json_number(datum->yaw_rad)}});
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

}  // namespace

std::string tile_head_json(const StackTile& tile,
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

Result<TileHead> parse_tile_head(std::string_view text) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const JsonDocument document,
      JsonDocument::parse(text, {}, {.max_bytes = kMaxTileHeadBytes, .max_depth = 4}));
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

}  // namespace hypermap
