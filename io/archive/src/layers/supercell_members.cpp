// SPDX-License-Identifier: BSD-3-Clause
#include "supercell_members.hpp"

#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "objects/text_lines.hpp"

#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

std::string line_of_node(const SupercellNode& node) {
  const auto log_odds = [](LogOdds value) { return json_number(value.value()); };
  const auto number = [](int value) { return std::to_string(value); };
  const std::string centroid =
      "[" + json_number(node.centroid.x()) + "," + json_number(node.centroid.y()) + "]";
  return json_object({{"centroid", centroid},
                      {"cells", std::to_string(node.num_cells)},
                      {"neighbours", json_array(node.neighbours, number)},
                      {"log_odds", json_array(node.log_odds, log_odds)},
                      {"mean", json_array(node.mean, log_odds)}}) +
         "\n";
}

Result<LogOdds> log_odds_of(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, node.number());
  return LogOdds(value);
}

Result<SupercellNode> parse_node(const JsonNode& json) {
  HYPERMAP_TRY(expect_keys(json, {"centroid", "cells", "neighbours", "log_odds", "mean"}));
  SupercellNode node;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode centroid, json.require("centroid"));
  HYPERMAP_ASSIGN_OR_RETURN(node.centroid, vector_of<2>(centroid));
  HYPERMAP_ASSIGN_OR_RETURN(node.num_cells, integer_at<std::uint32_t>(json, "cells"));
  HYPERMAP_ASSIGN_OR_RETURN(node.neighbours, list_at(json, "neighbours", integer_of<int>));
  HYPERMAP_ASSIGN_OR_RETURN(node.log_odds, list_at(json, "log_odds", log_odds_of));
  HYPERMAP_ASSIGN_OR_RETURN(node.mean, list_at(json, "mean", log_odds_of));
  return node;
}

}  // namespace

std::string lines_of_nodes(const std::vector<SupercellNode>& nodes) {
  std::string text;
  for (const SupercellNode& node : nodes) text += line_of_node(node);
  return text;
}

Result<std::vector<SupercellNode>> nodes_of_lines(std::string_view text, std::size_t count) {
  std::vector<SupercellNode> nodes;
  TextLines lines(text);
  while (!lines.done() && nodes.size() < count) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, lines.take());
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document,
                              JsonDocument::parse(line, "", {}, lines.number()));
    HYPERMAP_ASSIGN_OR_RETURN(SupercellNode node, parse_node(document.root()));
    nodes.push_back(std::move(node));
  }
  if (lines.done() && nodes.size() == count) return nodes;
  return fail(ErrorCode::kMalformedFile,
              "must have a line for each of " + std::to_string(count) + " supercells, has " +
                  (lines.done() ? "only " + std::to_string(nodes.size()) : "more"));
}

}  // namespace hypermap
