// SPDX-License-Identifier: BSD-3-Clause
#include "cells_way.hpp"

#include "command.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "number_lists.hpp"
#include "stack_area.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <iterator>
#include <utility>

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

/// The place of the layer to avoid among those of the graph. Errors: kNotFound.
Result<std::size_t> avoided_layer(const TopometricGraph& graph, const std::string& name) {
  const auto known = supercells_of(graph, name);
  if (!known) return Unexpected(of_option(known.error(), "--avoid"));
  return static_cast<std::size_t>(std::ranges::find(graph.layers, name) - graph.layers.begin());
}

/// The end, where its supercell or the cell below it is more probably of a layer than not.
std::optional<AvoidedEnd> avoided_end(const End& end,
                                      bool is_of_supercell,
                                      const LogOddsGrid& layer) {
  const auto cell = cell_at(layer.geometry(), end.point);
  const bool is_of_cell = cell && layer.at(*cell) > 0;
  if (!is_of_supercell && !is_of_cell) return std::nullopt;
  return AvoidedEnd{end.name, place_text(end.point), end.supercell, is_of_supercell};
}

/// Cells of the way's supercells that are more probably of a layer than not.
std::size_t num_cells_of(const LogOddsGrid& layer,
                         const Supercells& supercells,
                         const GraphPath& path) {
  std::vector<bool> is_on_way(static_cast<std::size_t>(supercells.count), false);
  for (const int number : path.nodes) is_on_way[static_cast<std::size_t>(number)] = true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < supercells.labels.size(); ++i) {
    if (is_on_way[static_cast<std::size_t>(supercells.labels[i])] && layer.cells()[i] > 0) ++count;
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
  std::optional<std::size_t> avoided;
  if (request.avoid) {
    HYPERMAP_ASSIGN_OR_RETURN(avoided, avoided_layer(graph, *request.avoid));
  }
  const auto is_avoided = [&](int number) {
    return avoided && graph.nodes[static_cast<std::size_t>(number)].mean[*avoided] > LogOdds();
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
  if (!request.avoid) return way;
  way.avoided_layer = *request.avoid;
  const LogOddsGrid& layer = stack.layers().at(*request.avoid);
  for (const End& end : {from, to}) {
    if (auto found = avoided_end(end, is_avoided(end.supercell), layer)) {
      way.avoided_ends.push_back(std::move(*found));
    }
  }
  if (way.path) way.num_avoided_cells = num_cells_of(layer, supercells, *way.path);
  return way;
}

}  // namespace hypermap::app
