// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/tile_set.hpp"

#include "hypermap/io/archive/joined_map.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/json_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kMaxIndexBytes = std::uint64_t{16} << 20U;

/// Corners of a rectangle with an inside.
Result<Rect> rect_of(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 4));
  std::array<double, 4> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(numbers[i], node.at(i).number());
  }
  const Rect rect{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
  const bool has_inside = (rect.min.array() < rect.max.array()).all();
  if (has_inside) return rect;
  return node.error(ErrorCode::kMalformedFile, "must be [x, y, x, y] from low to high");
}

/// The name of a file in the folder: it leads nowhere else.
Result<std::string> tile_file(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, node.string());
  const bool is_plain = name.find_first_of("/\\") == std::string_view::npos &&
                        !name.starts_with('.') && name.ends_with(".hmap");
  if (is_plain) return std::string(name);
  return node.error(
      ErrorCode::kMalformedFile,
      "must be the name of an archive beside the index, is '" + printable(name) + "'");
}

Result<MapTile> tile_of_json(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"file", "area", "voxels", "objects"}, {"reach"}));
  MapTile tile;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode file, node.require("file"));
  HYPERMAP_ASSIGN_OR_RETURN(tile.file, tile_file(file));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode area, node.require("area"));
  HYPERMAP_ASSIGN_OR_RETURN(tile.area, rect_of(area));
  tile.reach = tile.area;
  if (const auto reach = node.find("reach")) {
    HYPERMAP_ASSIGN_OR_RETURN(tile.reach, rect_of(*reach));
  }
  HYPERMAP_ASSIGN_OR_RETURN(tile.num_voxels, integer_at<std::uint64_t>(node, "voxels"));
  HYPERMAP_ASSIGN_OR_RETURN(tile.num_objects, integer_at<std::uint64_t>(node, "objects"));
  return tile;
}

Result<void> refuse_repeated_tiles(const JsonNode& tiles, const std::vector<MapTile>& all) {
  std::set<std::string> files;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (files.insert(all[i].file).second) continue;
    return tiles.at(i).error(ErrorCode::kMalformedFile, "'" + all[i].file + "' stands there twice");
  }
  return {};
}

std::filesystem::path index_of(const std::filesystem::path& path) {
  std::error_code failed;
  return std::filesystem::is_directory(path, failed) ? path / kTileIndexName : path;
}

}  // namespace

bool is_tile_set(const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path index = index_of(path);
  return index.filename() == kTileIndexName && std::filesystem::is_regular_file(index, failed);
}

Result<TileSet> parse_tile_set(std::string_view text, const std::filesystem::path& index) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const JsonDocument document,
      JsonDocument::parse(
          text, index.string(), {.max_bytes = static_cast<std::size_t>(kMaxIndexBytes)}));
  const JsonNode root = document.root();
  HYPERMAP_TRY(expect_keys(root, {"tile_m", "tiles"}));
  TileSet set{.folder = index.parent_path()};
  HYPERMAP_ASSIGN_OR_RETURN(set.edge_m, number_at(root, "tile_m"));
  HYPERMAP_ASSIGN_OR_RETURN(set.tiles, list_at(root, "tiles", tile_of_json));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode tiles, root.require("tiles"));
  if (set.tiles.empty()) return tiles.error(ErrorCode::kMalformedFile, "names no tile");
  HYPERMAP_TRY(refuse_repeated_tiles(tiles, set.tiles));
  return set;
}

Result<TileSet> read_tile_set(const std::filesystem::path& path) {
  const std::filesystem::path index = index_of(path);
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(index, kMaxIndexBytes));
  return parse_tile_set(text, index);
}

std::vector<std::size_t> tiles_reached(const TileSet& set, const std::optional<Rect>& asked) {
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < set.tiles.size(); ++i) {
    const Rect& reach = set.tiles[i].reach;
    const bool is_reached = !asked || ((reach.min.array() <= asked->max.array()).all() &&
                                       (asked->min.array() <= reach.max.array()).all());
    if (is_reached) reached.push_back(i);
  }
  return reached;
}

Result<Loaded<PartialMap>> load_tiles(const TileSet& set,
                                      const std::vector<std::size_t>& asked,
                                      const ArchiveParts& parts,
                                      const ArchiveLimits& limits,
                                      const StopCheck& stop) {
  const std::vector<std::size_t> none_but_first{0};
  const std::vector<std::size_t>& tiles = asked.empty() ? none_but_first : asked;
  Loaded<PartialMap> loaded;
  std::vector<MapArchive> maps;
  for (const std::size_t tile : tiles) {
    const std::filesystem::path file = set.folder / set.tiles[tile].file;
    HYPERMAP_ASSIGN_OR_RETURN(auto one,
                              load_archive_parts(file, parts, limits, archive_layer_types(), stop));
    std::ranges::move(one.findings, std::back_inserter(loaded.findings));
    loaded.value.octree_resolution_m = one.value.octree_resolution_m;
    maps.push_back(std::move(one.value.map));
  }
  auto whole = joined(std::move(maps));
  if (!whole) {
    Error error = std::move(whole).error();
    error.file = set.folder.string();
    return Unexpected(std::move(error));
  }
  loaded.value.map = std::move(*whole);
  return loaded;
}

}  // namespace hypermap
