// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/codec/base64.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "object_chunks.hpp"
#include "voted_cells_code.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// The two lines of an object, with their ends.
struct ObjectLines {
  std::string state;
  std::string cells;
};

/// Writes one object and remembers whether everything in it can be written.
class ObjectWriter {
 public:
  [[nodiscard]] bool ok() const { return ok_; }

  ObjectLines lines_of(const Object& object) {
    const VotedCellsCode cells = voted_cells_code(object.points.state().votes);
    return {.state = json_of(object, cells) + "\n",
            .cells = json_quoted(encode_base64(cells.bytes)) + "\n"};
  }

 private:
  std::string json_of(const Object& object, const VotedCellsCode& cells) {
    std::string text = json_object({{"id", count(object.id.value)},
                                    {"belief", json_of(object.belief)},
                                    {"existence", number(object.existence)},
                                    {"box_confidence", number(object.box_confidence)},
                                    {"box", json_of(object.box)},
                                    {"centroid", vector(object.centroid_in_map)},
                                    {"histogram", json_of(object.histogram)},
                                    {"shapes", json_of(object.shapes)},
                                    {"points", json_of(object.points, cells)},
                                    {"ledger", json_of(object.observation_log)},
                                    {"first_seen_ns", std::to_string(object.first_seen.ns)},
                                    {"last_seen_ns", std::to_string(object.last_seen.ns)},
                                    {"num_observations", count(object.num_observations)},
                                    {"farthest_detection_m", number(object.farthest_detection_m)}});
    if (object.prior.empty()) return text;
    return joined(std::move(text), json_object({{"prior", json_of(object.prior.log_factors())}}));
  }

  std::string number(double value) {
    if (!std::isfinite(value)) {
      ok_ = false;
      return "null";
    }
    return json_number(value);
  }
  std::string number(LogOdds value) { return number(value.value()); }
  std::string number(float value) {
    return std::isfinite(value) ? json_single(value) : number(static_cast<double>(value));
  }
  std::string count(std::uint64_t value) {
    ok_ = ok_ && value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    return std::to_string(value);
  }
  template <class Vector>
  std::string vector(const Vector& v) {
    std::string text = "[";
    for (Eigen::Index i = 0; i < v.size(); ++i) text += (i > 0 ? "," : "") + number(v(i));
    return text + "]";
  }

  std::string json_of(const Box& box) {
    return "[" + vector(box.min_in_map) + "," + vector(box.max_in_map) + "]";
  }

  std::string json_of(std::span<const ClassLogOdds> classes) {
    return json_array(classes, [this](const ClassLogOdds& entry) {
      return "[" + count(entry.id.value) + "," + number(entry.log_odds) + "]";
    });
  }

  std::string json_of(const ClassBelief& belief) {
    const ClassBeliefOptions& options = belief.options();
    return json_object(
        {{"max_log_odds", number(options.max_log_odds)},
         {"min_log_odds", number(options.min_log_odds)},
         {"saturation", options.saturation == Saturation::kClamp ? "\"clamp\"" : "\"shift\""},
         {"tempering", options.tempering == ClassTempering::kNone ? "\"none\"" : "\"views\""},
         {"classes", json_of(belief.entries())}});
  }

  std::string json_of(const VisibilityHistogram& histogram) {
    const VisibilityHistogramOptions& options = histogram.options();
    return json_object(
        {{"base_increment", number(options.base_increment)},
         {"weights", json_array(options.weights, [this](double w) { return number(w); })},
         {"max_log_odds", number(options.max_log_odds)},
         {"min_log_odds", number(options.min_log_odds)},
         {"visible_above", number(options.visible_above)},
         {"hidden_below", number(options.hidden_below)},
         {"confidence",
          options.confidence == HistogramConfidence::kEvidence ? "\"evidence\"" : "\"counted\""},
         {"bins", json_array(histogram.bins(), [this](LogOdds bin) { return number(bin); })}});
  }

  std::string json_of(const Ring& ring) {
    return json_array(ring, [this](const Eigen::Vector2d& point) { return vector(point); });
  }
  std::string json_of(const Polygon& polygon) {
    std::string text = "[" + json_of(polygon.outer);
    for (const Ring& hole : polygon.holes) text += "," + json_of(hole);
    return text + "]";
  }

  std::string json_of(const ShapeEvidence& evidence) {
    const ShapeEvidenceState& state = evidence.state();
    return json_object(
        {{"num_seen", count(state.num_seen)},
         {"centroid_sum", vector(state.centroid_sum)},
         {"hull", state.hull ? json_of(*state.hull) : "null"},
         {"kept", json_array(state.shapes, [this](const Polygon& p) { return json_of(p); })}});
  }

  std::string json_of(const OccupancyVotes& evidence, const VotedCellsCode& cells) {
    const OccupancyVotesOptions& options = evidence.options();
    const OccupancyVotesState& state = evidence.state();
    std::string text = joined(json_object({{"first_edge_m", number(options.edge_m)},
                                           {"max_cells", count(options.max_cells)},
                                           {"min_vote_share", number(options.min_vote_share)},
                                           {"min_block_share", number(options.min_block_share)},
                                           {"edge_m", number(state.edge_m)},
                                           {"num_observations", count(state.num_observations)}}),
                              place_of(cells));
    if (state.looks.empty()) return text;
    const VotedCellsCode looks = voted_cells_code(state.looks);
    const std::string cells_of_looks =
        json_object({{"cells", json_quoted(encode_base64(looks.bytes))}});
    return joined(text, json_object({{"looks", joined(place_of(looks), cells_of_looks)}}));
  }

  /// Where the cells of a code lie.
  std::string place_of(const VotedCellsCode& cells) {
    return json_object({{"origin",
                         json_array(std::array{cells.origin.x, cells.origin.y, cells.origin.z},
                                    [](std::int32_t c) { return std::to_string(c); })},
                        {"levels", std::to_string(cells.levels)},
                        {"num_cells", std::to_string(cells.num_cells)}});
  }

  /// One object with the keys of both. Requires: neither is empty.
  static std::string joined(std::string first, const std::string& second) {
    first.back() = ',';
    return first + second.substr(1);
  }

  std::string json_of(const BeliefChanges& changes) {
    return json_array(changes.entries(), [this](const BeliefChange& change) {
      return "[" + count(change.class_id.value) + "," + number(change.log_odds) + "]";
    });
  }
  /// Kind, visibility and the rest in the order of ObservationLogEntry's fields; the changes of
  /// other classes where there are any.
  std::string json_of(const ObservationLogEntry& entry) {
    const bool has_others = !entry.other_changes.entries().empty();
    return "[" + count(entry.frame_index) + "," + std::to_string(entry.stamp.ns) + "," +
           std::to_string(static_cast<int>(entry.kind)) + "," +
           std::to_string(static_cast<int>(entry.visibility)) + "," + count(entry.detector.value) +
           "," + count(entry.class_id.value) + "," + number(entry.score) + "," +
           number(entry.bearing_rad) + "," + number(entry.distance_m) + "," + number(entry.effect) +
           "," + number(entry.belief_change) +
           (has_others ? "," + json_of(entry.other_changes) : "") + "]";
  }
  /// In the order of ObservationLogSummary's fields.
  std::string json_of(const ObservationLogSummary& summary) {
    return "[" + std::to_string(static_cast<int>(summary.kind)) + "," +
           count(summary.detector.value) + "," + count(summary.class_id.value) + "," +
           std::to_string(static_cast<int>(summary.bearing_bin)) + "," + count(summary.count) +
           "," + number(summary.score_sum) + "," + number(summary.effect_sum) + "," +
           count(summary.last_frame_index) + "]";
  }
  std::string json_of(const ObservationLog& observation_log) {
    const ObservationLogState& state = observation_log.state();
    const auto json = [this](const auto& item) { return json_of(item); };
    return json_object({{"first", state.first ? json_of(*state.first) : "null"},
                        {"newest", json_array(state.newest, json)},
                        {"summaries", json_array(state.summaries, json)},
                        {"num_unsummarised", count(state.num_unsummarised)}});
  }

  bool ok_ = true;
};

Result<ObjectLines> lines_of(const Object& object) {
  ObjectWriter writer;
  ObjectLines lines = writer.lines_of(object);
  if (writer.ok()) return lines;
  return fail(ErrorCode::kInvalidArgument,
              "has a number that is not finite or a count beyond 2^63",
              "object " + std::to_string(object.id.value));
}

}  // namespace

Result<std::string> write_objects(const ObjectMap& objects) try {
  std::string text = json_object({{"format", "\"hypermap-objects\""},
                                  {"version", std::to_string(kObjectsVersion)},
                                  {"num_objects", std::to_string(objects.size())},
                                  {"next_id", std::to_string(objects.next_id().value)}}) +
                     "\n";
  std::vector<const Object*> all;
  all.reserve(objects.size());
  for (const Object& object : objects.objects()) all.push_back(&object);
  std::string cells;
  HYPERMAP_TRY(for_each_in_order<ObjectLines>(
      all.size(),
      [&all](std::size_t i) { return lines_of(*all[i]); },
      [&](const ObjectLines& lines) -> Result<void> {
        text += lines.state;
        cells += lines.cells;
        return {};
      }));
  text += cells;
  return text;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the objects");
}

}  // namespace hypermap
