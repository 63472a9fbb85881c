// SPDX-License-Identifier: BSD-3-Clause
#include "voted_points_from_json.hpp"

#include "hypermap/io/codec/base64.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "voted_cells_code.hpp"
#include "voted_cells_text.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Result<std::string> text_at(const JsonNode& object, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view text, node.string());
  return std::string(text);
}

Result<PointVote> parse_vote(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 4));
  PointVote vote;
  HYPERMAP_ASSIGN_OR_RETURN(vote.cell.x, integer_of<std::int32_t>(node.at(0)));
  HYPERMAP_ASSIGN_OR_RETURN(vote.cell.y, integer_of<std::int32_t>(node.at(1)));
  HYPERMAP_ASSIGN_OR_RETURN(vote.cell.z, integer_of<std::int32_t>(node.at(2)));
  HYPERMAP_ASSIGN_OR_RETURN(vote.votes, integer_of<std::uint32_t>(node.at(3)));
  return vote;
}

Result<PointCell> origin_at(const JsonNode& points) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto origin, list_at(points, "origin", integer_of<std::int32_t>));
  HYPERMAP_TRY(expect_array(*points.find("origin"), 3));
  return PointCell{.x = origin[0], .y = origin[1], .z = origin[2]};
}

/// Of version 2. Errors: those of voted_cells, at the key that they name.
Result<std::vector<PointVote>> parse_cells_text(const JsonNode& points, std::uint32_t max_cells) {
  VotedCellsText text;
  HYPERMAP_ASSIGN_OR_RETURN(text.origin, origin_at(points));
  HYPERMAP_ASSIGN_OR_RETURN(text.levels, integer_at<std::int32_t>(points, "levels"));
  HYPERMAP_ASSIGN_OR_RETURN(text.masks, text_at(points, "cells"));
  HYPERMAP_ASSIGN_OR_RETURN(text.votes, text_at(points, "votes"));
  auto votes = voted_cells(text, max_cells);
  if (votes) return votes;
  return points.find(votes.error().field)->error(votes.error().code, votes.error().what);
}

/// Of version 3. Errors: those of voted_cells, at the key that they name or at `cells`.
Result<std::vector<PointVote>> parse_cells_code(const JsonNode& points,
                                                const JsonNode& cells,
                                                std::uint32_t max_cells) {
  VotedCellsCode code;
  HYPERMAP_ASSIGN_OR_RETURN(code.origin, origin_at(points));
  HYPERMAP_ASSIGN_OR_RETURN(code.levels, integer_at<std::int32_t>(points, "levels"));
  HYPERMAP_ASSIGN_OR_RETURN(code.num_cells, integer_at<std::uint32_t>(points, "num_cells"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view letters, cells.string());
  auto bytes = decode_base64(letters);
  if (!bytes) return cells.error(bytes.error().code, bytes.error().what);
  code.bytes = *std::move(bytes);
  auto votes = voted_cells(code, max_cells);
  if (votes) return votes;
  const auto key = points.find(votes.error().field);
  return key ? key->error(votes.error().code, votes.error().what)
             : cells.error(votes.error().code, "its bytes " + votes.error().what);
}

/// Version 1 lists cells and votes as numbers.
Result<std::vector<PointVote>> parse_votes(const JsonNode& points,
                                           const std::optional<JsonNode>& cells,
                                           std::uint32_t max_cells) {
  if (cells) return parse_cells_code(points, *cells, max_cells);
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode votes, points.require("votes"));
  return votes.is(JsonKind::kString) ? parse_cells_text(points, max_cells)
                                     : list_of(votes, parse_vote);
}

/// How often blocks were in view; none in an older file, and where all were in view each time.
Result<std::vector<PointVote>> parse_looks(const JsonNode& points, std::uint32_t max_cells) {
  const auto looks = points.find("looks");
  if (!looks) return std::vector<PointVote>{};
  HYPERMAP_TRY(expect_keys(*looks, {"origin", "levels", "num_cells", "cells"}));
  return parse_cells_code(*looks, *looks->find("cells"), max_cells);
}

/// The keys of a file with or without lines of cells.
Result<void> check_keys(const JsonNode& points, bool has_cell_line) {
  if (has_cell_line)
    return expect_keys(points,
                       {"first_edge_m",
                        "max_cells",
                        "min_vote_share",
                        "min_block_share",
                        "edge_m",
                        "num_observations",
                        "origin",
                        "levels",
                        "num_cells"},
                       {"looks"});
  return expect_keys(
      points,
      {"first_edge_m", "max_cells", "min_vote_share", "edge_m", "num_observations", "votes"},
      {"min_block_share", "origin", "levels", "cells"});
}

}  // namespace

Result<OccupancyVotes> voted_points_from_json(const JsonNode& node,
                                              const std::optional<JsonNode>& cells) {
  HYPERMAP_TRY(check_keys(node, cells.has_value()));
  OccupancyVotesOptions options;
  OccupancyVotesState state;
  HYPERMAP_ASSIGN_OR_RETURN(options.edge_m, number_at(node, "first_edge_m"));
  HYPERMAP_ASSIGN_OR_RETURN(options.max_cells, integer_at<std::uint32_t>(node, "max_cells"));
  HYPERMAP_ASSIGN_OR_RETURN(options.min_vote_share, number_at(node, "min_vote_share"));
  options.min_block_share = 0.0;  // an older file does not ask for it
  if (node.find("min_block_share")) {
    HYPERMAP_ASSIGN_OR_RETURN(options.min_block_share, number_at(node, "min_block_share"));
  }
  HYPERMAP_TRY(validated(node, validate(options)));  // max_cells bounds what is read
  HYPERMAP_ASSIGN_OR_RETURN(state.edge_m, number_at(node, "edge_m"));
  HYPERMAP_ASSIGN_OR_RETURN(state.num_observations,
                            integer_at<std::uint32_t>(node, "num_observations"));
  HYPERMAP_ASSIGN_OR_RETURN(state.votes, parse_votes(node, cells, options.max_cells));
  HYPERMAP_ASSIGN_OR_RETURN(state.looks, parse_looks(node, options.max_cells));
  return validated(node, OccupancyVotes::from_state(options, std::move(state)));
}

}  // namespace hypermap
