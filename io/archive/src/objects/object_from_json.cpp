// SPDX-License-Identifier: BSD-3-Clause
#include "object_from_json.hpp"

#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/value_limits.hpp"
#include "observation_log_from_json.hpp"
#include "voted_points_from_json.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Result<LogOdds> log_odds_at(const JsonNode& object, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, number_at(object, key));
  return LogOdds(value);
}

Result<ClassLogOdds> parse_class(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 2));
  HYPERMAP_ASSIGN_OR_RETURN(const auto id, integer_of<std::uint32_t>(node.at(0)));
  HYPERMAP_ASSIGN_OR_RETURN(const double log_odds, node.at(1).number());
  return ClassLogOdds{.id = ClassId{id}, .log_odds = LogOdds(log_odds)};
}

/// An older file, which does not say it, means the sum.
Result<ClassTempering> tempering_at(const JsonNode& belief) {
  const auto tempering = belief.find("tempering");
  if (!tempering) return ClassTempering::kNone;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, tempering->string());
  if (name != "none" && name != "views")
    return tempering->error(ErrorCode::kMalformedFile, "expected none or views");
  return name == "none" ? ClassTempering::kNone : ClassTempering::kViews;
}

Result<ClassBelief> parse_belief(const JsonNode& node) {
  HYPERMAP_TRY(
      expect_keys(node, {"max_log_odds", "min_log_odds", "saturation", "classes"}, {"tempering"}));
  ClassBeliefOptions options;
  HYPERMAP_ASSIGN_OR_RETURN(options.max_log_odds, log_odds_at(node, "max_log_odds"));
  HYPERMAP_ASSIGN_OR_RETURN(options.min_log_odds, log_odds_at(node, "min_log_odds"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode saturation, node.require("saturation"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, saturation.string());
  if (name != "clamp" && name != "shift")
    return saturation.error(ErrorCode::kMalformedFile, "expected clamp or shift");
  options.saturation = name == "clamp" ? Saturation::kClamp : Saturation::kShift;
  HYPERMAP_ASSIGN_OR_RETURN(options.tempering, tempering_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(auto entries, list_at(node, "classes", parse_class));
  return validated(node, ClassBelief::from_entries(options, std::move(entries)));
}

Result<ClassPrior> parse_prior(const JsonNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(auto log_factors, list_of(node, parse_class));
  return validated(node, ClassPrior::create(std::move(log_factors)));
}

/// An older file, which does not say it, counts bins.
Result<HistogramConfidence> histogram_confidence_at(const JsonNode& histogram) {
  const auto rule = histogram.find("confidence");
  if (!rule) return HistogramConfidence::kCounted;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, rule->string());
  if (name != "evidence" && name != "counted")
    return rule->error(ErrorCode::kMalformedFile, "expected evidence or counted");
  return name == "evidence" ? HistogramConfidence::kEvidence : HistogramConfidence::kCounted;
}

Result<VisibilityHistogram> parse_histogram(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node,
                           {"base_increment",
                            "weights",
                            "max_log_odds",
                            "min_log_odds",
                            "visible_above",
                            "hidden_below",
                            "bins"},
                           {"confidence"}));
  VisibilityHistogramOptions options;
  HYPERMAP_ASSIGN_OR_RETURN(options.base_increment, number_at(node, "base_increment"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode weights, node.require("weights"));
  HYPERMAP_TRY(expect_array(weights, options.weights.size()));
  for (std::size_t i = 0; i < options.weights.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(options.weights[i], weights.at(i).number());
  }
  HYPERMAP_ASSIGN_OR_RETURN(options.max_log_odds, log_odds_at(node, "max_log_odds"));
  HYPERMAP_ASSIGN_OR_RETURN(options.min_log_odds, log_odds_at(node, "min_log_odds"));
  HYPERMAP_ASSIGN_OR_RETURN(options.visible_above, number_at(node, "visible_above"));
  HYPERMAP_ASSIGN_OR_RETURN(options.hidden_below, number_at(node, "hidden_below"));
  HYPERMAP_ASSIGN_OR_RETURN(options.confidence, histogram_confidence_at(node));
  HYPERMAP_ASSIGN_OR_RETURN(auto bins, list_at(node, "bins", [](const JsonNode& bin) {
                              return bin.number().map([](double l) { return LogOdds(l); });
                            }));
  options.num_bins = static_cast<int>(bins.size());
  return validated(node, VisibilityHistogram::from_bins(options, std::move(bins)));
}

Result<Box> parse_box(const JsonNode& node) {
  HYPERMAP_TRY(expect_array(node, 2));
  Box box;
  HYPERMAP_ASSIGN_OR_RETURN(box.min_in_map, vector_of<3>(node.at(0)));
  HYPERMAP_ASSIGN_OR_RETURN(box.max_in_map, vector_of<3>(node.at(1)));
  return box;
}

/// Reads objects; knows the limit on vertices.
class ObjectReader {
 public:
  ObjectReader(const std::optional<JsonNode>& cells, const ObjectFileLimits& limits)
      : cells_(cells), limits_(limits) {}

  [[nodiscard]] Result<Object> parse(const JsonNode& node) const {
    HYPERMAP_TRY(expect_keys(node,
                             {"id",
                              "belief",
                              "existence",
                              "box_confidence",
                              "box",
                              "centroid",
                              "histogram",
                              "shapes",
                              "points",
                              "ledger",
                              "first_seen_ns",
                              "last_seen_ns",
                              "num_observations",
                              "farthest_detection_m"},
                             {"prior"}));
    Object object;
    HYPERMAP_ASSIGN_OR_RETURN(object.id.value, integer_at<std::uint32_t>(node, "id"));
    HYPERMAP_ASSIGN_OR_RETURN(object.existence, log_odds_at(node, "existence"));
    HYPERMAP_ASSIGN_OR_RETURN(object.box_confidence, log_odds_at(node, "box_confidence"));
    HYPERMAP_ASSIGN_OR_RETURN(object.box, part(node, "box", parse_box));
    HYPERMAP_ASSIGN_OR_RETURN(object.centroid_in_map, part(node, "centroid", vector_of<3>));
    HYPERMAP_ASSIGN_OR_RETURN(object.belief, part(node, "belief", parse_belief));
    if (const auto prior = node.find("prior")) {
      HYPERMAP_ASSIGN_OR_RETURN(object.prior, parse_prior(*prior));
    }
    HYPERMAP_ASSIGN_OR_RETURN(object.histogram, part(node, "histogram", parse_histogram));
    HYPERMAP_ASSIGN_OR_RETURN(object.shapes, part(node, "shapes", [this](const JsonNode& shapes) {
                                return parse_shapes(shapes);
                              }));
    HYPERMAP_ASSIGN_OR_RETURN(object.points, part(node, "points", [this](const JsonNode& points) {
                                return voted_points_from_json(points, cells_);
                              }));
    HYPERMAP_ASSIGN_OR_RETURN(object.observation_log,
                              part(node, "ledger", observation_log_from_json));
    HYPERMAP_ASSIGN_OR_RETURN(object.first_seen.ns,
                              integer_at<std::int64_t>(node, "first_seen_ns"));
    HYPERMAP_ASSIGN_OR_RETURN(object.last_seen.ns, integer_at<std::int64_t>(node, "last_seen_ns"));
    HYPERMAP_ASSIGN_OR_RETURN(object.num_observations,
                              integer_at<std::uint32_t>(node, "num_observations"));
    HYPERMAP_ASSIGN_OR_RETURN(object.farthest_detection_m, number_at(node, "farthest_detection_m"));
    return object;
  }

 private:
  template <class Parse>
  static auto part(const JsonNode& object, std::string_view key, const Parse& parse)
      -> decltype(parse(object)) {
    HYPERMAP_ASSIGN_OR_RETURN(const JsonNode node, object.require(key));
    return parse(node);
  }

  static Result<Eigen::Vector2d> parse_vertex(const JsonNode& node) {
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector2d point, vector_of<2>(node));
    if (point.cwiseAbs().maxCoeff() > kMaxCoordinate)
      return node.error(ErrorCode::kMalformedFile, "lies beyond 1e6 m");
    return point;
  }

  [[nodiscard]] Result<Ring> parse_ring(const JsonNode& node) const {
    HYPERMAP_ASSIGN_OR_RETURN(Ring ring, list_of(node, parse_vertex));
    if (ring.size() < 3 || ring.size() > limits_.max_vertices)
      return node.error(ring.size() < 3 ? ErrorCode::kMalformedFile : ErrorCode::kLimit,
                        "ring of " + std::to_string(ring.size()) + " points, expected 3 to " +
                            std::to_string(limits_.max_vertices));
    return ring;
  }

  [[nodiscard]] Result<Polygon> parse_polygon(const JsonNode& node) const {
    HYPERMAP_ASSIGN_OR_RETURN(
        auto rings, list_of(node, [this](const JsonNode& ring) { return parse_ring(ring); }));
    if (rings.empty()) return node.error(ErrorCode::kMalformedFile, "polygon without a ring");
    Polygon polygon;
    polygon.outer = std::move(rings.front());
    rings.erase(rings.begin());
    polygon.holes = std::move(rings);
    return polygon;
  }

  [[nodiscard]] Result<ShapeEvidence> parse_shapes(const JsonNode& node) const {
    HYPERMAP_TRY(expect_keys(node, {"num_seen", "centroid_sum", "hull", "kept"}));
    ShapeEvidenceState state;
    HYPERMAP_ASSIGN_OR_RETURN(state.num_seen, integer_at<std::uint64_t>(node, "num_seen"));
    HYPERMAP_ASSIGN_OR_RETURN(state.centroid_sum, part(node, "centroid_sum", vector_of<2>));
    HYPERMAP_ASSIGN_OR_RETURN(const JsonNode hull, node.require("hull"));
    if (!hull.is(JsonKind::kNull)) {
      HYPERMAP_ASSIGN_OR_RETURN(state.hull, parse_polygon(hull));
    }
    HYPERMAP_ASSIGN_OR_RETURN(state.shapes, list_at(node, "kept", [this](const JsonNode& shape) {
                                return parse_polygon(shape);
                              }));
    return validated(node, ShapeEvidence::from_state(std::move(state)));
  }

  const std::optional<JsonNode>& cells_;
  const ObjectFileLimits& limits_;
};

}  // namespace

Result<Object> object_from_json(const JsonNode& node,
                                const std::optional<JsonNode>& cells,
                                const ObjectFileLimits& limits) {
  return ObjectReader(cells, limits).parse(node);
}

}  // namespace hypermap
