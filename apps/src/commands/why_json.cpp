// SPDX-License-Identifier: BSD-3-Clause
#include "why_json.hpp"

#include "hypermap/io/archive/map_sessions.hpp"

#include <nlohmann/json.hpp>

#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

double degrees_of(float bearing_rad) {
  return static_cast<double>(bearing_rad) * 180.0 / std::numbers::pi;
}

/// The key of a condition in JSON.
std::string_view key_of(Condition condition) {
  switch (condition) {
    case Condition::kObservations:
      return "observations";
    case Condition::kClass:
      return "class";
    case Condition::kNotGone:
      return "not_gone";
    case Condition::kRealProbability:
      return "real_probability";
    case Condition::kExistence:
      return "existence";
    case Condition::kConfidence:
      return "confidence";
    case Condition::kOwnPlace:
      return "own_place";
  }
  return "";
}

/// Null where the map did not keep it.
Json session_json(const MapArchive& archive, std::uint64_t frame_index) {
  const auto session = session_of_frame(sessions_of(archive.provenance), frame_index);
  return session ? Json(name_of(*session)) : Json(nullptr);
}

Json json_of(const ObservationLogEntry& entry, const MapArchive& archive) {
  return {{"stamp_s", static_cast<double>(entry.stamp.ns) * 1e-9},
          {"frame", entry.frame_index},
          {"session", session_json(archive, entry.frame_index)},
          {"detected", entry.kind == ObservationKind::kDetection},
          {"distance_m", entry.distance_m},
          {"bearing_deg", degrees_of(entry.bearing_rad)}};
}

/// The newest detection; of one that is no longer kept by itself, the frame alone.
Json json_of_last_seen(const Explanation& why, const MapArchive& archive) {
  if (why.last_seen) return json_of(*why.last_seen, archive);
  if (why.last_seen_frame) {
    return {{"frame", *why.last_seen_frame},
            {"session", session_json(archive, *why.last_seen_frame)}};
  }
  return nullptr;
}

/// Null for a detector of before their names were kept.
Json name_of(DetectorId id, const DetectorRegistry& detectors) {
  return detectors.contains(id) ? Json(detectors.description(id).name) : Json(nullptr);
}

/// Null for a class that the map has no name of.
Json name_of(ClassId id, const ClassRegistry& classes) {
  return classes.contains(id) ? Json(classes.name(id)) : Json(nullptr);
}

Json json_of(const BeliefChanges& changes, const ClassRegistry& classes) {
  Json all = Json::array();
  for (const BeliefChange& change : changes.entries()) {
    all.push_back(
        {{"class", name_of(change.class_id, classes)}, {"belief_change", change.log_odds}});
  }
  return all;
}

/// What the newest observations, of those that are kept one by one, did to the object.
Json log_json(const Explanation& why, const MapArchive& archive) {
  Json log = Json::array();
  for (const ObservationLogEntry& entry :
       archive.objects.at(why.id).observation_log.state().newest) {
    Json one = json_of(entry, archive);
    if (entry.kind == ObservationKind::kDetection) {
      one["detector"] = name_of(entry.detector, archive.detectors);
      one["score"] = entry.score;
    } else {
      one["visible_share"] = entry.score;
    }
    one["class"] = name_of(entry.class_id, archive.classes);
    one["existence_change"] = entry.effect;
    one["belief_change"] = entry.belief_change;
    one["other_changes"] = json_of(entry.other_changes, archive.classes);
    log.push_back(std::move(one));
  }
  return log;
}

Json json_of(const Removal& removal) {
  const auto number = [](const std::optional<std::uint32_t>& looks) {
    return looks ? Json(*looks) : Json(nullptr);
  };
  Json threshold = nullptr;
  if (removal.threshold) threshold = removal.threshold->removed_below.value();
  return {{"clear_looks", removal.clear_looks.looks},
          {"looks_until_gone", number(removal.looks_until_gone)},
          {"seconds_until_gone", removal.seconds_until_gone},
          {"looks_until_removed", number(removal.looks_until_removed)},
          {"looks_until_removed_unseen_side", number(removal.looks_until_removed_unseen)},
          {"removed_below_confidence", std::move(threshold)}};
}

/// Factors of the class and of the runner-up; null where nothing is known besides detections.
Json prior_json(const Explanation& why, const ClassRegistry& classes) {
  if (!why.prior) return nullptr;
  const auto& all = why.beliefs.classes;
  Json factors = {{{"name", classes.name(all[0].id)}, {"factor", why.prior->best}},
                  {{"name", classes.name(all[1].id)}, {"factor", why.prior->runner_up}}};
  return {{"classes", std::move(factors)},
          {"of_each_observation", why.prior->is_of_each_observation}};
}

Json json_of(const Explanation& why, const MapArchive& archive, bool is_shown) {
  const ClassRegistry& classes = archive.classes;
  Json out{{"id", why.id.value},
           {"name",
            why.beliefs.classes.empty() ? "unknown" : classes.name(why.beliefs.classes.front().id)},
           {"shown", is_shown},
           {"confidence", why.confidence.value()},
           {"real_probability", why.beliefs.real.value()},
           {"classes", Json::array()},
           {"withheld_for", Json::array()},
           {"first", why.first ? json_of(*why.first, archive) : Json(nullptr)},
           {"last_seen", json_of_last_seen(why, archive)},
           {"last", why.newest ? json_of(*why.newest, archive) : Json(nullptr)},
           {"directions_deg", Json::array()},
           {"namings", Json::array()}};
  for (const ClassEvidence& c : why.beliefs.classes) {
    out["classes"].push_back(
        {{"name", classes.name(c.id)}, {"probability", c.probability.value()}});
  }
  out["prior"] = prior_json(why, classes);
  for (const MissedCondition& missed : why.missed_conditions) {
    Json one{{"condition", key_of(missed.condition)}};
    if (missed.condition == Condition::kOwnPlace) {
      one["stronger"] = missed.stronger.value;
    } else {
      one["value"] = missed.value;
      one["limit"] = missed.limit;
    }
    out["withheld_for"].push_back(std::move(one));
  }
  for (const std::uint8_t bin : why.directions) {
    out["directions_deg"].push_back(bin * ObservationLog::kDegreesPerBearingBin);
  }
  for (const Naming& naming : why.namings) {
    out["namings"].push_back({{"class", classes.name(naming.class_id)},
                              {"detector", name_of(naming.detector, archive.detectors)},
                              {"detector_id", naming.detector.value},
                              {"detections", naming.num_detections},
                              {"mean_score", naming.mean_score},
                              {"directions", naming.num_directions},
                              {"last_frame", naming.last_frame_index}});
  }
  out["missed_detections"] = {{"frames", why.missed_detections.num_frames},
                              {"mean_visible_share", why.missed_detections.mean_visible_share},
                              {"existence_lost", why.missed_detections.existence_lost}};
  out["removal"] = json_of(why.removal);
  out["log"] = log_json(why, archive);
  return out;
}

Json json_of(const std::optional<NearestObject>& nearest) {
  if (!nearest) return nullptr;
  return {{"id", nearest->id.value}, {"distance_m", nearest->distance_m}};
}

Json json_of(const PlaceExplanation& place, const MapArchive& archive, const PlanPoint& at) {
  Json out{{"position", {at.xy.x(), at.xy.y()}},
           {"shown", Json::array()},
           {"space", place.space ? Json(*place.space) : Json(nullptr)},
           {"nearest", json_of(place.nearest)},
           {"nearest_withheld", json_of(place.nearest_withheld)},
           {"withheld", Json::array()}};
  if (at.z) out["position"].push_back(*at.z);
  for (const ObjectId id : place.shown) out["shown"].push_back(id.value);
  for (const Explanation& why : place.withheld) {
    out["withheld"].push_back(json_of(why, archive, false));
  }
  return out;
}

std::string document(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const Explanation& why, const MapArchive& archive, bool is_shown) {
  return document(json_of(why, archive, is_shown));
}

std::string json_text(const PlaceExplanation& place,
                      const MapArchive& archive,
                      const PlanPoint& at) {
  return document(json_of(place, archive, at));
}

}  // namespace hypermap::app
