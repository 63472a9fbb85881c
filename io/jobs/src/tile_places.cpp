// SPDX-License-Identifier: BSD-3-Clause
#include "tile_places.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace hypermap {
namespace {

VertexId vertex(std::size_t number) {
  return VertexId{static_cast<std::uint32_t>(number)};
}

/// Where each vertex is; none outside all regions.
std::vector<std::optional<TileVertex>> vertices_in_tiles(const TopologicalMap& places,
                                                         std::span<const CropRegion> regions) {
  std::vector<std::optional<TileVertex>> found;
  std::vector<std::size_t> num_in(regions.size(), 0);
  for (const TopologicalVertex& one : places.vertices()) {
    const auto region = std::ranges::find_if(
        regions, [&](const CropRegion& tile) { return tile.contains(one.position_in_map); });
    const auto tile = static_cast<std::size_t>(region - regions.begin());
    found.emplace_back();
    if (region != regions.end()) found.back() = TileVertex{tile, num_in[tile]++};
  }
  return found;
}

}  // namespace

std::vector<TileWay> ways_between(const TopologicalMap& places,
                                  std::span<const CropRegion> regions) {
  const auto in_tiles = vertices_in_tiles(places, regions);
  std::vector<TileWay> ways;
  for (const TopologicalEdge& edge : places.edges()) {
    const auto& from = in_tiles[edge.from.value];
    const auto& to = in_tiles[edge.to.value];
    if (from && to && from->tile != to->tile) ways.push_back({*from, *to});
  }
  return ways;
}

Result<TopologicalMap> own_places(const TopologicalMap& places, std::size_t num_own) {
  if (num_own > places.vertices().size()) {
    return fail(ErrorCode::kMalformedFile,
                "must be at most those of the tile, " + std::to_string(places.vertices().size()) +
                    ", are " + std::to_string(num_own),
                "vertices");
  }
  std::vector<TopologicalEdge> edges = places.edges();
  std::erase_if(edges, [&](const TopologicalEdge& edge) { return edge.to.value >= num_own; });
  return TopologicalMap::create(
      places.options(), std::span(places.vertices()).first(num_own), edges, std::nullopt);
}

Result<TopologicalMap> with_ways(const TopologicalMap& places,
                                 std::span<const TileWay> ways,
                                 const std::map<std::size_t, std::size_t>& first_vertex_of_tile) {
  std::vector<TopologicalEdge> edges = places.edges();
  for (const TileWay& way : ways) {
    const auto from = first_vertex_of_tile.find(way.from.tile);
    const auto to = first_vertex_of_tile.find(way.to.tile);
    if (from == first_vertex_of_tile.end() || to == first_vertex_of_tile.end()) continue;
    const auto [low, high] =
        std::minmax({from->second + way.from.number, to->second + way.to.number});
    edges.push_back({.from = vertex(low), .to = vertex(high)});
  }
  std::ranges::sort(edges);
  return TopologicalMap::create(places.options(), places.vertices(), edges, std::nullopt);
}

}  // namespace hypermap
