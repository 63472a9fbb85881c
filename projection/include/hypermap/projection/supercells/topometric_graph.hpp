// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A stack as a graph: supercells with what they say on each layer, and which of them touch.
///
/// Source: [sogm] III-D.2, Eq. (11), figure 6.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/evidence_color.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/supercells/supercells.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The triplet of one supercell: where it is (T_c), what it touches (L_c), what it says (P_c).
struct SupercellNode {
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< Mean of its cells' centres.
  std::size_t num_cells = 0;
  std::vector<int> neighbours =
      {};  ///< Supercells that share an edge of a cell with it, ascending.
  std::vector<LogOdds> log_odds = {};  ///< Of each layer: the sum over its cells, [sogm] Eq. (11).
  std::vector<LogOdds> mean = {};      ///< Of each layer: the same over the number of its cells.
  friend bool operator==(const SupercellNode&, const SupercellNode&) = default;
};

/// Nodes by the numbers of their supercells. Unit: metre. Frame: the stack's.
struct TopometricGraph {
  std::string frame_id;
  std::vector<std::string> layers;  ///< Their names, ascending, as in the nodes' vectors.
  std::vector<SupercellNode> nodes;
  friend bool operator==(const TopometricGraph&, const TopometricGraph&) = default;
};

/// Source: [sogm] Eq. (11). Deviation: products of odds over many cells overflow, log-odds do not.
/// Boundary: unknown cells have log-odds 0. Errors: kInvalidArgument when the supercells are of
/// another geometry than the stack; kOutOfMemory. Cost: O(cells * layers).
[[nodiscard]] Result<TopometricGraph> topometric_graph(const GridStack& stack,
                                                       const Supercells& supercells);

/// The supercells whose mean on a layer is at least this probable, by number; not those of which
/// the layer says nothing. Errors: kNotFound for a name that is no layer's, telling those that
/// there are.
[[nodiscard]] Result<std::vector<int>> supercells_of(const TopometricGraph& graph,
                                                     std::string_view layer,
                                                     Probability at_least = Probability(0.5));

/// The place of the layer of the largest mean above 0, the first of equal ones; none when every
/// layer is unknown or says no.
[[nodiscard]] std::optional<std::size_t> best_layer(const SupercellNode& node);

/// What its layers say of a node together, the best one by `best_layer`. Valid as long as `graph`.
[[nodiscard]] PlaceEvidence evidence_of(const SupercellNode& node, const TopometricGraph& graph);

/// Of each supercell, whether no layer says anything of more than half of its cells.
/// Errors: as topometric_graph. Cost: O(cells * layers).
[[nodiscard]] Result<std::vector<bool>> unknown_supercells(const GridStack& stack,
                                                           const Supercells& supercells);

/// From node to neighbouring node.
struct GraphPath {
  std::vector<int> nodes;  ///< The first and the last one included.
  double length_m = 0.0;   ///< Between centroids.
};

/// Whether a way may lead through the supercell of a number.
using IsPassable = std::function<bool(int)>;

/// The shortest way over passable nodes (Dijkstra); none when there is none. Of equally short ones
/// always the same. Requires: both are nodes.
/// Boundary: the two ends are never asked whether they are passable; from a node to itself it is 0.
/// Cost: O((nodes + edges) log nodes).
[[nodiscard]] std::optional<GraphPath> shortest_path(const TopometricGraph& graph,
                                                     int from,
                                                     int to,
                                                     const IsPassable& is_passable = {});

}  // namespace hypermap
