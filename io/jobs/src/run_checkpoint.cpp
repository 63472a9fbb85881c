// SPDX-License-Identifier: BSD-3-Clause
#include "run_checkpoint.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::int64_t kMaxCount = std::int64_t{1} << 62;
/// Of the reason why a frame was skipped.
constexpr std::size_t kMaxReasonBytes = 1000;

/// A count of the report and its key.
struct CountKey {
  std::string_view key;
  std::size_t& (*of)(MappingReport& report);
  bool may_be_absent = false;  ///< 0 then: checkpoints of older programs do not have it.
};

constexpr std::array kCountKeys{
    CountKey{"frames", [](MappingReport& r) -> std::size_t& { return r.num_frames; }},
    CountKey{"looks", [](MappingReport& r) -> std::size_t& { return r.num_looks; }},
    CountKey{"detections", [](MappingReport& r) -> std::size_t& { return r.num_detections; }},
    CountKey{"filtered", [](MappingReport& r) -> std::size_t& { return r.num_filtered; }},
    CountKey{"segments", [](MappingReport& r) -> std::size_t& { return r.num_segments; }},
    CountKey{"visibility_skipped",
             [](MappingReport& r) -> std::size_t& { return r.num_visibility_skipped; }},
    CountKey{"hits", [](MappingReport& r) -> std::size_t& { return r.points.num_hits; }},
    CountKey{"beyond_range",
             [](MappingReport& r) -> std::size_t& { return r.points.num_beyond_range; }},
    CountKey{"not_measured",
             [](MappingReport& r) -> std::size_t& { return r.points.num_not_measured; }},
    CountKey{"not_finite",
             [](MappingReport& r) -> std::size_t& { return r.points.num_not_finite; }},
    CountKey{"outside_volume",
             [](MappingReport& r) -> std::size_t& { return r.points.num_outside_volume; }},
    CountKey{
        "transient", [](MappingReport& r) -> std::size_t& { return r.points.num_transient; }, true},
};

/// In digits alone, however large.
ValueTree count_tree(std::size_t count) {
  ValueTree tree = make_number(0.0);
  tree.text = std::to_string(count);
  return tree;
}

ValueTree frame_tree(const NotedFrame& frame) {
  return make_map({{"position", count_tree(frame.position)}, {"hash", make_text(frame.hash)}});
}

ValueTree skipped_tree(std::size_t position, const Error& error) {
  return make_map({{"position", count_tree(position)},
                   {"reason", make_text(printable(to_string(error), kMaxReasonBytes))},
                   {"is_systems_fault", make_bool(error.code == ErrorCode::kIo)}});
}

Result<std::size_t> count_at(const YamlNode& map, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t count, node.as_int(0, kMaxCount));
  return static_cast<std::size_t>(count);
}

/// A position below `end`.
Result<std::size_t> position_at(const YamlNode& map, std::size_t end) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at("position"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t position,
                            node.as_int(0, static_cast<std::int64_t>(end) - 1));
  return static_cast<std::size_t>(position);
}

Result<NotedFrame> frame_at(const YamlNode& map, std::string_view key, std::size_t end) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  NotedFrame frame;
  HYPERMAP_ASSIGN_OR_RETURN(frame.position, position_at(node, end));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode hash, node.at("hash"));
  HYPERMAP_ASSIGN_OR_RETURN(frame.hash, hash.as_string());
  return frame;
}

Result<void> take_skipped(const YamlNode& node, RunCheckpoint& checkpoint) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t position,
                            position_at(node, checkpoint.num_positions));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode reason_node, node.at("reason"));
  HYPERMAP_ASSIGN_OR_RETURN(std::string reason, reason_node.as_string());
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode fault_node, node.at("is_systems_fault"));
  HYPERMAP_ASSIGN_OR_RETURN(const bool is_systems_fault, fault_node.as_bool());
  if (!checkpoint.skipped_positions.empty() && position <= checkpoint.skipped_positions.back())
    return Unexpected(node.error("must come after position " +
                                 std::to_string(checkpoint.skipped_positions.back()) + ", is " +
                                 std::to_string(position)));
  checkpoint.skipped_positions.push_back(position);
  checkpoint.report.skipped.push_back(
      {.code = is_systems_fault ? ErrorCode::kIo : ErrorCode::kMalformedFile,
       .what = std::move(reason)});
  return {};
}

}  // namespace

ValueTree to_tree(const RunCheckpoint& checkpoint) {
  MappingReport report = checkpoint.report;
  std::vector<ValueTree::Entry> counts;
  counts.reserve(kCountKeys.size());
  for (const CountKey& count : kCountKeys)
    counts.emplace_back(count.key, count_tree(count.of(report)));
  std::vector<ValueTree> skipped;
  skipped.reserve(report.skipped.size());
  for (std::size_t i = 0; i < report.skipped.size(); ++i)
    skipped.push_back(skipped_tree(checkpoint.skipped_positions[i], report.skipped[i]));
  return make_map({{"positions", count_tree(checkpoint.num_positions)},
                   {"first", frame_tree(checkpoint.first)},
                   {"last", frame_tree(checkpoint.last)},
                   {"counts", make_map(std::move(counts))},
                   {"skipped", make_list(std::move(skipped))},
                   {"settings", checkpoint.settings}});
}

Result<RunCheckpoint> parse_run_checkpoint(const ValueTree& tree, const std::string& file) {
  const SourceName source{.file = file, .entry = "checkpoint"};
  const YamlNode root(tree, "", source);
  RunCheckpoint checkpoint;
  HYPERMAP_ASSIGN_OR_RETURN(checkpoint.num_positions, count_at(root, "positions"));
  HYPERMAP_ASSIGN_OR_RETURN(checkpoint.first, frame_at(root, "first", checkpoint.num_positions));
  HYPERMAP_ASSIGN_OR_RETURN(checkpoint.last, frame_at(root, "last", checkpoint.num_positions));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode counts, root.at("counts"));
  for (const CountKey& count : kCountKeys) {
    if (count.may_be_absent && !counts.find(count.key)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(count.of(checkpoint.report), count_at(counts, count.key));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode skipped, root.at("skipped"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> skipped_frames, skipped.as_list());
  for (const YamlNode& node : skipped_frames) HYPERMAP_TRY(take_skipped(node, checkpoint));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode settings, root.at("settings"));
  HYPERMAP_TRY(settings.as_map());
  checkpoint.settings = settings.value();
  return checkpoint;
}

}  // namespace hypermap
