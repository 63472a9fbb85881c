// SPDX-License-Identifier: BSD-3-Clause
#include "cells_text.hpp"

#include "hypermap/core/base/count_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

std::string list_of(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text.empty() ? "none" : text;
}

std::string listed_or(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " or ") + printable(name);
  return text;
}

void print_way(const Way& way) {
  std::printf("path: %s; %.3f m\n", list_of(way.path->nodes).c_str(), way.path->length_m);
  if (way.num_avoided_cells == 0) return;
  std::printf("its supercells hold %s more probably of %s than not\n",
              count_text(way.num_avoided_cells, "cell").c_str(),
              listed_or(way.avoided_layers).c_str());
}

}  // namespace

std::vector<std::string> layers_without_supercell(const GridStack& stack,
                                                  const TopometricGraph& graph) {
  std::vector<std::string> names;
  for (std::size_t place = 0; place < graph.layers.size(); ++place) {
    const auto cells = stack.layers().at(graph.layers[place]).cells();
    const bool says_yes = std::ranges::any_of(cells, [](auto steps) { return steps > 0; });
    const bool is_shown = std::ranges::any_of(
        graph.nodes, [place](const SupercellNode& node) { return node.mean[place] > LogOdds(); });
    if (says_yes && !is_shown) names.push_back(graph.layers[place]);
  }
  return names;
}

void print_cells_json(const CellsAnswer& answer) {
  Json files = Json::array();
  for (const auto& path : answer.files) files.push_back(path.string());
  Json document{{"frame", answer.graph.frame_id},
                {"supercells", answer.supercells.count},
                {"layers", answer.graph.layers},
                {"moves", answer.supercells.num_moves},
                {"first_energy", answer.supercells.first_energy},
                {"energy", answer.supercells.energy},
                {"without_supercell", answer.without_supercell},
                {"files", std::move(files)}};
  if (answer.of_layer) document["of"] = *answer.of_layer;
  if (answer.way) {
    const Way& way = *answer.way;
    document["path"] =
        way.path ? Json{{"supercells", way.path->nodes}, {"length_m", way.path->length_m}} : Json();
    Json avoided = Json::array();
    for (const AvoidedEnd& end : way.avoided_ends) avoided.push_back(end.name);
    document["avoided_ends"] = std::move(avoided);
    document["avoided_cells"] = way.num_avoided_cells;
    document["unknown_supercells"] = way.unknown;
  }
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_cells_text(const CellsAnswer& answer) {
  std::printf("%s, %s; energy %.6f, before the moves %.6f\n",
              count_text(static_cast<std::size_t>(answer.supercells.count), "supercell").c_str(),
              count_text(answer.supercells.num_moves, "move").c_str(),
              answer.supercells.energy,
              answer.supercells.first_energy);
  for (const std::string& layer : answer.without_supercell) {
    std::printf(
        "no supercell is more probably of %s than not: what says so is outweighed by the "
        "other cells of its supercells\n",
        printable(layer).c_str());
  }
  if (answer.of_layer) std::printf("found: %s\n", list_of(*answer.of_layer).c_str());
  if (answer.way && answer.way->path) print_way(*answer.way);
  for (const auto& path : answer.files) std::printf("%s\n", path.c_str());
}

}  // namespace hypermap::app
