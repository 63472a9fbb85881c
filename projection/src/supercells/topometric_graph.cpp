// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/nearest_name.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <queue>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Whole sums over the cells of one supercell.
struct NodeSums {
  std::int64_t num_cells = 0;
  std::int64_t cols = 0;
  std::int64_t rows = 0;
  std::vector<std::int64_t> steps;  ///< Of each layer.
  std::set<int> neighbours;
};

void sum_cells(std::vector<NodeSums>& sums, const GridStack& stack, const Supercells& supercells) {
  const GridGeometry& geometry = stack.geometry();
  const auto label = [&](int col, int row) {
    return supercells.labels[geometry.index({col, row})];
  };
  const auto join = [&sums](int a, int b) {
    if (a == b) return;
    sums[static_cast<std::size_t>(a)].neighbours.insert(b);
    sums[static_cast<std::size_t>(b)].neighbours.insert(a);
  };
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      NodeSums& node = sums[static_cast<std::size_t>(label(col, row))];
      ++node.num_cells;
      node.cols += col;
      node.rows += row;
      if (col > 0) join(label(col - 1, row), label(col, row));
      if (row > 0) join(label(col, row - 1), label(col, row));
    }
  }
}

void sum_layers(std::vector<NodeSums>& sums, const GridStack& stack, const Supercells& supercells) {
  std::size_t layer = 0;
  for (const auto& [name, grid] : stack.layers()) {
    for (std::size_t i = 0; i < grid.cells().size(); ++i) {
      sums[static_cast<std::size_t>(supercells.labels[i])].steps[layer] += grid.cells()[i];
    }
    ++layer;
  }
}

SupercellNode node_of(const NodeSums& sums, const GridGeometry& geometry) {
  const auto count = static_cast<double>(sums.num_cells);
  SupercellNode node;
  node.num_cells = static_cast<std::size_t>(sums.num_cells);
  node.centroid = from_cells(
      geometry,
      {static_cast<double>(sums.cols) / count + 0.5, static_cast<double>(sums.rows) / count + 0.5});
  node.neighbours.assign(sums.neighbours.begin(), sums.neighbours.end());
  for (const std::int64_t steps : sums.steps) {
    node.log_odds.emplace_back(static_cast<double>(steps) / 1000.0);
    node.mean.emplace_back(static_cast<double>(steps) / 1000.0 / count);
  }
  return node;
}

Result<void> check_match(const GridStack& stack, const Supercells& supercells) {
  const bool is_match = supercells.geometry == stack.geometry() &&
                        supercells.labels.size() == stack.geometry().num_cells();
  if (is_match) return {};
  return fail(ErrorCode::kInvalidArgument, "must be of the stack's cells", "supercells");
}

/// Distances from one node, and the node before each.
struct Reached {
  std::vector<double> distance_m;
  std::vector<int> before;
};

Reached reach_from(const TopometricGraph& graph, int from, int to, const IsPassable& is_passable) {
  const std::size_t count = graph.nodes.size();
  Reached reached{std::vector<double>(count, kUnreached), std::vector<int>(count, -1)};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  reached.distance_m[static_cast<std::size_t>(from)] = 0.0;
  waiting.emplace(0.0, from);
  while (!waiting.empty() && waiting.top().second != to) {
    const auto [distance_m, here] = waiting.top();
    waiting.pop();
    const SupercellNode& node = graph.nodes[static_cast<std::size_t>(here)];
    if (distance_m > reached.distance_m[static_cast<std::size_t>(here)]) continue;
    for (const int next : node.neighbours) {
      const auto n = static_cast<std::size_t>(next);
      const SupercellNode& other = graph.nodes[n];
      if (next != to && is_passable && !is_passable(next)) continue;
      const double further_m = distance_m + (other.centroid - node.centroid).norm();
      if (further_m >= reached.distance_m[n]) continue;
      reached.distance_m[n] = further_m;
      reached.before[n] = here;
      waiting.emplace(further_m, next);
    }
  }
  return reached;
}

}  // namespace

Result<TopometricGraph> topometric_graph(const GridStack& stack, const Supercells& supercells) {
  HYPERMAP_TRY(check_match(stack, supercells));
  return guarded(ErrorCode::kInvalidArgument, "the graph", [&]() -> Result<TopometricGraph> {
    NodeSums none;
    none.steps.assign(stack.layers().size(), 0);
    std::vector<NodeSums> sums(static_cast<std::size_t>(supercells.count), none);
    sum_cells(sums, stack, supercells);
    sum_layers(sums, stack, supercells);
    TopometricGraph graph{.frame_id = stack.options().frame_id, .layers = {}, .nodes = {}};
    for (const auto& [name, grid] : stack.layers()) graph.layers.push_back(name);
    for (const NodeSums& node : sums) graph.nodes.push_back(node_of(node, stack.geometry()));
    return graph;
  });
}

Result<std::vector<int>> supercells_of(const TopometricGraph& graph,
                                       std::string_view layer,
                                       Probability at_least) {
  const auto found = std::ranges::find(graph.layers, layer);
  if (found == graph.layers.end()) {
    return fail(ErrorCode::kNotFound, nothing_named("layer", layer, graph.layers), "layer");
  }
  const auto place = static_cast<std::size_t>(found - graph.layers.begin());
  std::vector<int> numbers;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const LogOdds mean = graph.nodes[i].mean[place];
    const bool is_known = mean != LogOdds();
    if (is_known && mean.probability() >= at_least) numbers.push_back(static_cast<int>(i));
  }
  return numbers;
}

Result<std::vector<bool>> unknown_supercells(const GridStack& stack, const Supercells& supercells) {
  HYPERMAP_TRY(check_match(stack, supercells));
  return guarded(ErrorCode::kInvalidArgument, "the supercells", [&]() -> Result<std::vector<bool>> {
    std::vector<bool> is_known(stack.geometry().num_cells(), false);
    for (const auto& [name, grid] : stack.layers()) {
      for (std::size_t i = 0; i < is_known.size(); ++i) {
        if (grid.cells()[i] != 0) is_known[i] = true;
      }
    }
    const auto count = static_cast<std::size_t>(supercells.count);
    std::vector<std::size_t> num_cells(count, 0);
    std::vector<std::size_t> num_known(count, 0);
    for (std::size_t i = 0; i < is_known.size(); ++i) {
      const auto number = static_cast<std::size_t>(supercells.labels[i]);
      ++num_cells[number];
      if (is_known[i]) ++num_known[number];
    }
    std::vector<bool> is_unknown(count, false);
    for (std::size_t n = 0; n < count; ++n) is_unknown[n] = 2 * num_known[n] < num_cells[n];
    return is_unknown;
  });
}

std::optional<std::size_t> best_layer(const SupercellNode& node) {
  const auto best = std::ranges::max_element(node.mean);
  if (best == node.mean.end() || *best <= LogOdds()) return std::nullopt;
  return static_cast<std::size_t>(best - node.mean.begin());
}

PlaceEvidence evidence_of(const SupercellNode& node, const TopometricGraph& graph) {
  PlaceEvidence evidence;
  if (const auto best = best_layer(node)) evidence.best_layer = graph.layers[*best];
  evidence.is_known =
      std::ranges::any_of(node.mean, [](LogOdds mean) { return mean != LogOdds(); });
  return evidence;
}

std::optional<GraphPath> shortest_path(const TopometricGraph& graph,
                                       int from,
                                       int to,
                                       const IsPassable& is_passable) {
  const auto last = static_cast<std::size_t>(to);
  assert(from >= 0 && to >= 0 && last < graph.nodes.size());
  const Reached reached = reach_from(graph, from, to, is_passable);
  if (reached.distance_m[last] == kUnreached) return std::nullopt;
  GraphPath path{.nodes = {to}, .length_m = reached.distance_m[last]};
  while (path.nodes.back() != from) {
    path.nodes.push_back(reached.before[static_cast<std::size_t>(path.nodes.back())]);
  }
  std::ranges::reverse(path.nodes);
  return path;
}

}  // namespace hypermap
