// SPDX-License-Identifier: BSD-3-Clause
#include "observation_log_from_json.hpp"

#include "hypermap/io/codec/json_fields.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr int kNumVisibilities = 5;

/// Kind and visibility are stored as their numbers.
template <class Enum>
Result<Enum> enum_of(const JsonNode& node, int num_values) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value, node.integer(0, num_values - 1));
  return static_cast<Enum>(value);
}

Result<BeliefChange> parse_belief_change(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 2));
  BeliefChange change;
  HYPERMAP_ASSIGN_OR_RETURN(change.class_id.value, integer_of<std::uint32_t>(node.at(0)));
  HYPERMAP_ASSIGN_OR_RETURN(change.log_odds, float_of(node.at(1)));
  return change;
}

Result<BeliefChanges> parse_belief_changes(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, list_of(node, parse_belief_change));
  return validated(node, BeliefChanges::from_entries(entries));
}

/// Older archives have no changes of beliefs, or of the named class alone.
Result<ObservationLogEntry> parse_log_entry(const JsonNode& node) {
  constexpr std::size_t kOldest = 10;
  constexpr std::size_t kNewest = 12;
  HYPERMAP_TRY(expect_array(node, std::clamp(node.size(), kOldest, kNewest)));
  ObservationLogEntry entry;
  HYPERMAP_ASSIGN_OR_RETURN(entry.frame_index, integer_of<std::uint64_t>(node.at(0)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.stamp.ns, integer_of<std::int64_t>(node.at(1)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.kind, enum_of<ObservationKind>(node.at(2), 2));
  HYPERMAP_ASSIGN_OR_RETURN(entry.visibility, enum_of<Visibility>(node.at(3), kNumVisibilities));
  HYPERMAP_ASSIGN_OR_RETURN(entry.detector.value, integer_of<std::uint32_t>(node.at(4)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.class_id.value, integer_of<std::uint32_t>(node.at(5)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.score, float_of(node.at(6)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.bearing_rad, float_of(node.at(7)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.distance_m, float_of(node.at(8)));
  HYPERMAP_ASSIGN_OR_RETURN(entry.effect, float_of(node.at(9)));
  if (node.size() > 10) {
    HYPERMAP_ASSIGN_OR_RETURN(entry.belief_change, float_of(node.at(10)));
  }
  if (node.size() > 11) {
    HYPERMAP_ASSIGN_OR_RETURN(entry.other_changes, parse_belief_changes(node.at(11)));
  }
  return entry;
}

Result<ObservationLogSummary> parse_log_summary(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 8));
  ObservationLogSummary summary;
  HYPERMAP_ASSIGN_OR_RETURN(summary.kind, enum_of<ObservationKind>(node.at(0), 2));
  HYPERMAP_ASSIGN_OR_RETURN(summary.detector.value, integer_of<std::uint32_t>(node.at(1)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.class_id.value, integer_of<std::uint32_t>(node.at(2)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.bearing_bin, integer_of<std::uint8_t>(node.at(3)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.count, integer_of<std::uint32_t>(node.at(4)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.score_sum, float_of(node.at(5)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.effect_sum, float_of(node.at(6)));
  HYPERMAP_ASSIGN_OR_RETURN(summary.last_frame_index, integer_of<std::uint64_t>(node.at(7)));
  return summary;
}

}  // namespace

Result<ObservationLog> observation_log_from_json(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"first", "newest", "summaries", "num_unsummarised"}));
  ObservationLogState state;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode first, node.require("first"));
  if (!first.is(JsonKind::kNull)) {
    HYPERMAP_ASSIGN_OR_RETURN(state.first, parse_log_entry(first));
  }
  HYPERMAP_ASSIGN_OR_RETURN(state.newest, list_at(node, "newest", parse_log_entry));
  HYPERMAP_ASSIGN_OR_RETURN(state.summaries, list_at(node, "summaries", parse_log_summary));
  HYPERMAP_ASSIGN_OR_RETURN(state.num_unsummarised,
                            integer_at<std::uint64_t>(node, "num_unsummarised"));
  return validated(node, ObservationLog::from_state(std::move(state)));
}

}  // namespace hypermap
