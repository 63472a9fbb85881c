// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is near in a topological map, how to get from one place to another, and whether the map
/// obeys its rules.
#pragma once

#include "hypermap/core/places/topological_map.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// The vertices that at most `num_layers` edges lie between, `from` included, ascending.
///
/// Source: [smap] 3.5.4, 3.5.5 (candidates within 3 layers of the robot's vertex, 5 for absences).
/// Requires: a vertex of the map; num_layers >= 0. Cost: O(n log n) for n vertices found.
[[nodiscard]] std::vector<VertexId> neighbourhood(const TopologicalMap& map,
                                                  VertexId from,
                                                  int num_layers);

/// What a metre costs at a vertex: at least 0; infinity where no way may lead.
using TraversalCost = std::function<double(VertexId)>;

/// A way from vertex to vertex.
struct TopologicalRoute {
  std::vector<VertexId> vertices;  ///< The first and the last one included.
  double length_m = 0.0;
  double cost = 0.0;  ///< Of each edge half its length at the cost of either end.
  friend bool operator==(const TopologicalRoute&, const TopologicalRoute&) = default;
};

/// The cheapest way (Dijkstra); none when there is none of finite cost. Of equally cheap ones
/// always the same. Requires: both are vertices of the map; costs are at least 0, no NaN.
/// Boundary: no cost function: a metre costs 1. From a vertex to itself it is 0, whatever it costs.
/// Cost: O((vertices + edges) log vertices).
[[nodiscard]] std::optional<TopologicalRoute> cheapest_route(const TopologicalMap& map,
                                                             VertexId from,
                                                             VertexId to,
                                                             const TraversalCost& cost = {});

/// The places in whose pieces the map falls that no way joins: for each vertex the number of its
/// piece, from 0 on in the order of their first vertices. Cost: linear.
[[nodiscard]] std::vector<std::size_t> connected_pieces(const TopologicalMap& map);

/// A rule of [smap] 3.5.1 that does not hold, 1 to 3, and for what.
struct BrokenRule {
  int rule = 0;
  std::string what;  ///< "vertices 3 and 7 are joined and 2.1 m apart"
  friend bool operator==(const BrokenRule&, const BrokenRule&) = default;
};

/// The rules that a graph breaks: 1, joined vertices are nearer than 2 V_d; 2, each object is
/// nearer than V_d to a vertex; 3, no edge is longer than V_d E_f (`TopologicalMap::kRoundingM` is
/// rounding). Empty: all hold. It trusts nothing that TopologicalMap promises: graphs of others can
/// be asked, too. Frame: Map. Requires: edges name vertices. Cost: O(edges + objects * vertices).
[[nodiscard]] std::vector<BrokenRule> broken_rules(const TopologicalMapOptions& options,
                                                   std::span<const TopologicalVertex> vertices,
                                                   std::span<const TopologicalEdge> edges,
                                                   std::span<const Eigen::Vector3d> objects_in_map);
[[nodiscard]] std::vector<BrokenRule> broken_rules(const TopologicalMap& map,
                                                   std::span<const Eigen::Vector3d> objects_in_map);

}  // namespace hypermap
