// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/tile_set.hpp"

#include "hypermap/io/archive/joined_map.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "tile_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
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
  HYPERMAP_TRY(expect_keys(node, {"file", "area", "voxels", "objects"}, {"reach", "vertices"}));
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
  if (node.find("vertices")) {
    HYPERMAP_ASSIGN_OR_RETURN(tile.num_vertices, integer_at<std::uint32_t>(node, "vertices"));
  }
  return tile;
}

/// A vertex that the tile has of the map. Errors: kMalformedFile.
Result<TileVertex> vertex_at(const JsonNode& way, std::size_t at, const TileSet& set) {
  TileVertex vertex;
  HYPERMAP_ASSIGN_OR_RETURN(vertex.tile, integer_of<std::uint32_t>(way.at(at)));
  HYPERMAP_ASSIGN_OR_RETURN(vertex.number, integer_of<std::uint32_t>(way.at(at + 1)));
  if (vertex.tile < set.tiles.size() &&
      vertex.number < set.tiles[vertex.tile].num_vertices.value_or(0)) {
    return vertex;
  }
  return way.error(ErrorCode::kMalformedFile, "must be [tile, vertex, tile, vertex] of the tiles");
}

Result<TileWay> way_of_json(const JsonNode& node, const TileSet& set) {
  HYPERMAP_TRY(expect_array(node, 4));
  TileWay way;
  HYPERMAP_ASSIGN_OR_RETURN(way.from, vertex_at(node, 0, set));
  HYPERMAP_ASSIGN_OR_RETURN(way.to, vertex_at(node, 2, set));
  return way;
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
  HYPERMAP_TRY(expect_keys(root, {"tile_m", "tiles"}, {"ways"}));
  TileSet set{.folder = index.parent_path()};
  HYPERMAP_ASSIGN_OR_RETURN(set.edge_m, number_at(root, "tile_m"));
  HYPERMAP_ASSIGN_OR_RETURN(set.tiles, list_at(root, "tiles", tile_of_json));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode tiles, root.require("tiles"));
  if (set.tiles.empty()) return tiles.error(ErrorCode::kMalformedFile, "names no tile");
  HYPERMAP_TRY(refuse_repeated_tiles(tiles, set.tiles));
  if (root.find("ways")) {
    const auto parse = [&](const JsonNode& node) { return way_of_json(node, set); };
    HYPERMAP_ASSIGN_OR_RETURN(set.ways, list_at(root, "ways", parse));
  }
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

namespace {

Unexpected about(Error error, const std::filesystem::path& file) {
  error.file = file.string();
  return Unexpected(std::move(error));
}

/// A tile with those vertices alone that it has of the map, where the index tells of them.
Result<Loaded<PartialMap>> load_tile(const TileSet& set,
                                     std::size_t number,
                                     const ArchiveParts& parts,
                                     const ArchiveLimits& limits,
                                     const StopCheck& stop) {
  const MapTile& tile = set.tiles[number];
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive_parts(set.folder / tile.file, parts, limits, archive_layer_types(), stop));
  std::optional<TopologicalMap>& places = loaded.value.map.topological_map;
  if (!places || !tile.num_vertices) return loaded;
  auto own = own_places(*places, *tile.num_vertices);
  if (!own) return about(std::move(own).error(), set.folder / tile.file);
  places = std::move(*own);
  return loaded;
}

/// The tiles' vertices with the ways between them. Where tiles are missing, objects may be far from
/// all vertices.
Result<void> join_places(MapArchive& whole,
                         const TileSet& set,
                         const std::map<std::size_t, std::size_t>& first_vertex_of_tile) {
  if (!whole.topological_map) return {};
  HYPERMAP_ASSIGN_OR_RETURN(whole.topological_map,
                            with_ways(*whole.topological_map, set.ways, first_vertex_of_tile));
  if (first_vertex_of_tile.size() == set.tiles.size()) return {};
  for (const Object& object : whole.objects.objects()) {
    (void)whole.topological_map->cover(object.centroid_in_map);
  }
  return {};
}

}  // namespace

Result<Loaded<PartialMap>> load_tiles(const TileSet& set,
                                      const std::vector<std::size_t>& asked,
                                      const ArchiveParts& parts,
                                      const ArchiveLimits& limits,
                                      const StopCheck& stop) {
  const std::vector<std::size_t> none_but_first{0};
  const std::vector<std::size_t>& tiles = asked.empty() ? none_but_first : asked;
  Loaded<PartialMap> loaded;
  std::vector<MapArchive> maps;
  std::map<std::size_t, std::size_t> first_vertex_of_tile;
  std::size_t num_vertices = 0;
  for (const std::size_t tile : tiles) {
    HYPERMAP_ASSIGN_OR_RETURN(auto one, load_tile(set, tile, parts, limits, stop));
    std::ranges::move(one.findings, std::back_inserter(loaded.findings));
    loaded.value.octree_resolution_m = one.value.octree_resolution_m;
    first_vertex_of_tile[tile] = num_vertices;
    const auto& places = one.value.map.topological_map;
    num_vertices += places ? places->vertices().size() : 0;
    maps.push_back(std::move(one.value.map));
  }
  auto whole = joined(std::move(maps));
  if (!whole) return about(std::move(whole).error(), set.folder);
  if (auto done = join_places(*whole, set, first_vertex_of_tile); !done) {
    return about(std::move(done).error(), set.folder);
  }
  loaded.value.map = std::move(*whole);
  return loaded;
}

}  // namespace hypermap
