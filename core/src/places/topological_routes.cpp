// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/topological_routes.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace hypermap {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// What is known of the cheapest way to each vertex while it is sought.
struct Search {
  std::vector<double> cost;
  std::vector<VertexId> before;
};

Search search_from(const TopologicalMap& map,
                   VertexId from,
                   VertexId to,
                   const TraversalCost& cost) {
  Search search{.cost = std::vector<double>(map.vertices().size(), kUnreached),
                .before = std::vector<VertexId>(map.vertices().size())};
  using Reached = std::pair<double, VertexId>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  search.cost[from.value] = 0.0;
  open.emplace(0.0, from);
  const auto at = [&](VertexId id) { return cost ? cost(id) : 1.0; };
  while (!open.empty()) {
    const auto [so_far, id] = open.top();
    open.pop();
    if (id == to) break;
    if (so_far > search.cost[id.value]) continue;
    for (const VertexId next : map.neighbours(id)) {
      const double edge = map.distance_m(id, next) * 0.5 * (at(id) + at(next));
      assert(edge >= 0.0);
      if (!(so_far + edge < search.cost[next.value])) continue;
      search.cost[next.value] = so_far + edge;
      search.before[next.value] = id;
      open.emplace(so_far + edge, next);
    }
  }
  return search;
}

std::string both(const TopologicalEdge& edge) {
  return std::to_string(edge.from.value) + " and " + std::to_string(edge.to.value);
}

}  // namespace

std::vector<VertexId> neighbourhood(const TopologicalMap& map, VertexId from, int num_layers) {
  std::vector<VertexId> found{from};
  std::vector<VertexId> layer{from};
  for (int i = 0; i < num_layers && !layer.empty(); ++i) {
    std::vector<VertexId> next;
    for (const VertexId id : layer) {
      const auto joined = map.neighbours(id);
      next.insert(next.end(), joined.begin(), joined.end());
    }
    std::ranges::sort(next);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    layer.clear();
    std::ranges::set_difference(next, found, std::back_inserter(layer));
    const auto middle = found.insert(found.end(), layer.begin(), layer.end());
    std::inplace_merge(found.begin(), middle, found.end());
  }
  return found;
}

std::optional<TopologicalRoute> cheapest_route(const TopologicalMap& map,
                                               VertexId from,
                                               VertexId to,
                                               const TraversalCost& cost) {
  const Search search = search_from(map, from, to, cost);
  if (!std::isfinite(search.cost[to.value])) return std::nullopt;
  TopologicalRoute route{.vertices = {to}, .length_m = 0.0, .cost = search.cost[to.value]};
  while (route.vertices.back() != from) {
    const VertexId before = search.before[route.vertices.back().value];
    route.length_m += map.distance_m(before, route.vertices.back());
    route.vertices.push_back(before);
  }
  std::ranges::reverse(route.vertices);
  return route;
}

std::vector<std::size_t> connected_pieces(const TopologicalMap& map) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> piece_of(map.vertices().size(), kNone);
  std::size_t num_pieces = 0;
  for (std::uint32_t i = 0; i < piece_of.size(); ++i) {
    if (piece_of[i] != kNone) continue;
    std::vector<VertexId> open{VertexId{i}};
    piece_of[i] = num_pieces;
    while (!open.empty()) {
      const VertexId id = open.back();
      open.pop_back();
      for (const VertexId next : map.neighbours(id)) {
        if (piece_of[next.value] != kNone) continue;
        piece_of[next.value] = num_pieces;
        open.push_back(next);
      }
    }
    ++num_pieces;
  }
  return piece_of;
}

std::vector<BrokenRule> broken_rules(const TopologicalMapOptions& options,
                                     std::span<const TopologicalVertex> vertices,
                                     std::span<const TopologicalEdge> edges,
                                     std::span<const Eigen::Vector3d> objects_in_map) {
  std::vector<BrokenRule> broken;
  const double max_edge_m = options.vertex_distance_m * options.edge_factor;
  for (const TopologicalEdge& edge : edges) {
    const double length_m =
        (vertices[edge.from.value].position_in_map - vertices[edge.to.value].position_in_map)
            .norm();
    const std::string what =
        "vertices " + both(edge) + " are joined and " + number_text(length_m) + " m apart";
    if (!(length_m < 2.0 * options.vertex_distance_m)) broken.push_back({1, what});
    if (!(length_m <= max_edge_m + TopologicalMap::kRoundingM)) broken.push_back({3, what});
  }
  for (std::size_t i = 0; i < objects_in_map.size(); ++i) {
    double away_m = kUnreached;
    for (const TopologicalVertex& vertex : vertices) {
      away_m = std::min(away_m, (vertex.position_in_map - objects_in_map[i]).norm());
    }
    if (away_m < options.vertex_distance_m) continue;
    broken.push_back({2,
                      "object " + std::to_string(i) + " is " + number_text(away_m) +
                          " m from the nearest vertex"});
  }
  return broken;
}

std::vector<BrokenRule> broken_rules(const TopologicalMap& map,
                                     std::span<const Eigen::Vector3d> objects_in_map) {
  return broken_rules(map.options(), map.vertices(), map.edges(), objects_in_map);
}

}  // namespace hypermap
