// SPDX-License-Identifier: BSD-3-Clause
#include "cells_way.hpp"

#include "command.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "number_lists.hpp"
#include "stack_area.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

/// An end of a way as it was asked for.
struct End {
  const char* name = "";
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  int supercell = 0;
};

std::string place_text(const Eigen::Vector2d& point) {
  return number_text(point.x()) + "," + number_text(point.y());
}

/// Errors: kNotFound outside the grid.
Result<End> end_at(const char* name, const Eigen::Vector2d& point, const Supercells& supercells) {
  if (const auto number = supercell_at(supercells, point)) return End{name, point, *number};
  return fail(ErrorCode::kNotFound,
              "no cell is at " + place_text(point) + ", there are cells in " +
                  corners_text(bounds(supercells.geometry)),
              "--path");
}

/// The places of the layers to avoid among those of the graph. Errors: kNotFound.
Result<std::vector<std::size_t>> avoided_places(const TopometricGraph& graph,
                                                const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  places.reserve(names.size());
  for (const std::string& name : names) {
    const auto known = supercells_of(graph, name);
    if (!known) return Unexpected(of_option(known.error(), "--avoid"));
    const auto found = std::ranges::find(graph.layers, name);
    places.push_back(static_cast<std::size_t>(found - graph.layers.begin()));
  }
  return places;
}

/// What the end lies in: a supercell, or the cell below it, that is more probably of a layer to
/// avoid than not.
std::optional<AvoidedEnd> avoided_end(const End& end,
                                      const GridStack& stack,
                                      const TopometricGraph& graph,
                                      const std::vector<std::size_t>& avoided) {
  const auto& mean = graph.nodes[static_cast<std::size_t>(end.supercell)].mean;
  for (const std::size_t place : avoided) {
    const LogOddsGrid& layer = stack.layers().at(graph.layers[place]);
    const auto cell = cell_at(layer.geometry(), end.point);
    const bool is_of_cell = cell && layer.at(*cell) > 0;
    const bool is_of_supercell = mean[place] > LogOdds();
    if (!is_of_supercell && !is_of_cell) continue;
    return AvoidedEnd{
        end.name, place_text(end.point), end.supercell, graph.layers[place], is_of_supercell};
  }
  return std::nullopt;
}

/// Cells of the way's supercells that are more probably of one of the layers than not.
std::size_t num_cells_of(const GridStack& stack,
                         const std::vector<std::string>& names,
                         const Supercells& supercells,
                         const GraphPath& path) {
  std::vector<bool> is_on_way(static_cast<std::size_t>(supercells.count), false);
  for (const int number : path.nodes) is_on_way[static_cast<std::size_t>(number)] = true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < supercells.labels.size(); ++i) {
    if (!is_on_way[static_cast<std::size_t>(supercells.labels[i])]) continue;
    const bool is_of_any = std::ranges::any_of(
        names, [&](const auto& name) { return stack.layers().at(name).cells()[i] > 0; });
    if (is_of_any) ++count;
  }
  return count;
}

}  // namespace

Result<Way> find_way(const GridStack& stack,
                     const Supercells& supercells,
                     const TopometricGraph& graph,
                     const WayRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto at, parse_numbers(request.ends, 4, 4, "--path"));
  HYPERMAP_ASSIGN_OR_RETURN(const End from, end_at("start", {at[0], at[1]}, supercells));
  HYPERMAP_ASSIGN_OR_RETURN(const End to, end_at("end", {at[2], at[3]}, supercells));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<bool> is_unknown,
                            unknown_supercells(stack, supercells));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<std::size_t> avoided,
                            avoided_places(graph, request.avoid));
  const auto is_avoided = [&](int number) {
    const auto& mean = graph.nodes[static_cast<std::size_t>(number)].mean;
    return std::ranges::any_of(avoided, [&](std::size_t place) { return mean[place] > LogOdds(); });
  };
  Way way;
  way.path = shortest_path(graph, from.supercell, to.supercell, [&](int number) {
    return !is_avoided(number) && !(request.known && is_unknown[static_cast<std::size_t>(number)]);
  });
  if (way.path) {
    std::ranges::copy_if(way.path->nodes, std::back_inserter(way.unknown), [&](int number) {
      return is_unknown[static_cast<std::size_t>(number)];
    });
  }
  way.avoided_layers = request.avoid;
  for (const End& end : {from, to}) {
    if (auto found = avoided_end(end, stack, graph, avoided)) {
      way.avoided_ends.push_back(std::move(*found));
    }
  }
  if (way.path) way.num_avoided_cells = num_cells_of(stack, request.avoid, supercells, *way.path);
  return way;
}

}  // namespace hypermap::app
