// SPDX-License-Identifier: BSD-3-Clause
#include "why.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/archive/place_explanation.hpp"
#include "shown_rules.hpp"
#include "tables.hpp"
#include "why_effect.hpp"
#include "why_json.hpp"
#include "why_removal.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

/// Less probable classes are counted in the text; --json lists all.
constexpr double kLeastListed = 0.05;
/// Less probable ones are not even counted: two digits would say 0.00.
constexpr double kLeastCounted = 0.005;

double seconds_of(Stamp stamp) {
  return static_cast<double>(stamp.ns) * 1e-9;
}

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

std::string name_of(const Explanation& why, const ClassRegistry& classes) {
  const auto& all = why.beliefs.classes;
  return (all.empty() ? "unknown" : printable(classes.name(all.front().id))) + " " +
         std::to_string(why.id.value);
}

std::string text_of(const MissedCondition& missed) {
  const auto [value, limit] = fixed_apart(missed.value, missed.limit);
  const auto whole = [](double count) { return static_cast<std::uint64_t>(count); };
  switch (missed.condition) {
    case Condition::kObservations:
      return "seen " + times(whole(missed.value)) + ", " + std::to_string(whole(missed.limit)) +
             " are asked for";
    case Condition::kClass:
      return "no class was named";
    case Condition::kNotGone:
      return "gone: " + count_text(whole(missed.value), "clear look") +
             " in a row through its place, " + std::to_string(whole(missed.limit)) + " are enough";
    case Condition::kRealProbability:
      return "the probability " + value + " that it is real is below " + limit;
    case Condition::kExistence:
      return "its existence " + value + " is not above " + limit;
    case Condition::kConfidence:
      return "its confidence " + value + " is below " + limit;
    case Condition::kOwnPlace:
      return "object " + std::to_string(missed.stronger.value) +
             ", seen more often, has the same points";
  }
  return "";
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : between) + text;
  return out;
}

/// By the rules that the map was made by, where it keeps them.
std::string withheld_text(const std::vector<MissedCondition>& missed) {
  if (missed.empty())
    return "its layer of objects leaves it out, though no rule of publication does";
  std::vector<std::string> texts;
  texts.reserve(missed.size());
  for (const MissedCondition& one : missed) texts.push_back(text_of(one));
  return joined(texts, "; ");
}

/// ", session morning" in a map of several.
std::string session_text(const MapArchive& archive, std::uint64_t frame_index) {
  const std::vector<MapSession> sessions = sessions_of(archive.provenance);
  if (sessions.size() < 2) return "";
  const auto session = session_of_frame(sessions, frame_index);
  return session ? ", session " + printable(name_of(*session)) : "";
}

std::string moment_text(const ObservationLogEntry& entry, const MapArchive& archive) {
  return "at " + fixed(seconds_of(entry.stamp), 3) + " s (frame " +
         std::to_string(entry.frame_index) + session_text(archive, entry.frame_index) + ") from " +
         fixed(static_cast<double>(entry.distance_m), 2) + " m";
}

std::string directions_text(const std::vector<std::uint8_t>& bins) {
  std::vector<std::string> degrees;
  degrees.reserve(bins.size());
  for (const std::uint8_t bin : bins)
    degrees.push_back(fixed(bin * ObservationLog::kDegreesPerBearingBin, 0));
  return std::to_string(bins.size()) + " of " + std::to_string(ObservationLog::kNumBearingBins) +
         " directions (from " + joined(degrees, ", ") + " degrees on)";
}

std::string classes_text(const ObjectBeliefs& beliefs, const ClassRegistry& classes) {
  std::vector<std::string> texts;
  std::size_t num_others = 0;
  for (const ClassEvidence& c : beliefs.classes) {  // the most probable come first
    if (c.probability.value() < kLeastCounted) break;
    if (!texts.empty() && c.probability.value() < kLeastListed) {
      ++num_others;
      continue;
    }
    texts.push_back(printable(classes.name(c.id)) + " " + fixed(c.probability.value(), 2));
  }
  if (texts.empty()) return "of no class";
  return joined(texts, ", ") + (num_others > 0 ? " and " + count_text(num_others, "other") : "");
}

void print_line(std::string_view key, const std::string& text) {
  std::printf("  %-10s %s\n", std::string(key).c_str(), text.c_str());
}

std::string detector_text(DetectorId id, const DetectorRegistry& detectors) {
  return detectors.contains(id) ? printable(detectors.description(id).name)
                                : std::to_string(id.value);
}

void print_namings(const Explanation& why, const MapArchive& archive) {
  std::string_view key = "named";
  for (const Naming& naming : why.namings) {
    print_line(key,
               printable(archive.classes.name(naming.class_id)) + " " +
                   times(naming.num_detections) + " by detector " +
                   detector_text(naming.detector, archive.detectors) + ", from " +
                   count_text(static_cast<std::size_t>(naming.num_directions), "direction") +
                   ", score " + fixed(naming.mean_score, 2) + " in the mean");
    key = "";
  }
}

void print_removal(const Removal& removal, bool is_shown) {
  std::string_view key = "removal";
  for (const std::string& text : removal_texts(removal, is_shown)) {
    print_line(key, text);
    key = "";
  }
}

/// Which of the class and the runner-up outside knowledge favours, and by how much: nothing where
/// two digits would say that the runner-up is 0.00 probable or that both have the same factor.
void print_prior(const Explanation& why, const ClassRegistry& classes) {
  const auto& all = why.beliefs.classes;
  if (!why.prior || all[1].probability.value() < kLeastCounted) return;
  const double ratio = why.prior->best / why.prior->runner_up;
  const std::string times_as = fixed(std::max(ratio, 1.0 / ratio), 2);
  if (times_as == "1.00") return;
  const bool favours_best = ratio > 1.0;
  print_line("prior",
             "outside knowledge makes " + printable(classes.name(all[favours_best ? 0 : 1].id)) +
                 " " + times_as + " times as probable against " +
                 printable(classes.name(all[favours_best ? 1 : 0].id)) +
                 (why.prior->is_of_each_observation ? " in the newest observation"
                                                    : " as detections alone"));
}

/// Below its moment, what an observation changed; nothing where two digits would say 0.00.
void print_effect(const ObservationLogEntry& entry, const ClassRegistry& classes) {
  const std::string text = effect_text(entry, classes);
  if (!text.empty()) print_line("", text);
}

/// When it was detected first and last, and when a newer frame that should have shown it did not.
void print_moments(const Explanation& why, const MapArchive& archive) {
  if (why.first) print_line("first seen", moment_text(*why.first, archive));
  if (why.last_seen) {
    print_line("last seen", moment_text(*why.last_seen, archive));
    print_effect(*why.last_seen, archive.classes);
  } else if (const auto& frame = why.last_seen_frame) {
    print_line("last seen", "in frame " + std::to_string(*frame) + session_text(archive, *frame));
  }
  if (why.newest && why.newest->kind != ObservationKind::kDetection) {
    print_line("looked for", "last " + moment_text(*why.newest, archive) + ", not detected there");
    print_effect(*why.newest, archive.classes);
  }
}

void print_object(const Explanation& why, const MapArchive& archive, bool is_shown) {
  std::printf("%s is %s\n",
              name_of(why, archive.classes).c_str(),
              is_shown ? "shown" : ("withheld: " + withheld_text(why.missed_conditions)).c_str());
  print_line("belief",
             "confidence " + fixed(why.confidence.value(), 2) + ": real " +
                 fixed(why.beliefs.real.value(), 2) + "; " +
                 classes_text(why.beliefs, archive.classes));
  print_prior(why, archive.classes);
  std::uint64_t num_detections = 0;
  for (const Naming& naming : why.namings) num_detections += naming.num_detections;
  print_line("seen",
             num_detections == 0
                 ? "the map keeps no log of it"
                 : times(num_detections) + " from " + directions_text(why.directions));
  print_moments(why, archive);
  print_namings(why, archive);
  const MissedDetections& missed = why.missed_detections;
  if (missed.num_frames > 0) {
    print_line("doubted",
               "not detected in " + count_text(missed.num_frames, "frame") +
                   " that should have shown it, " + fixed(missed.mean_visible_share, 2) +
                   " of its surface seen there in the mean");
  }
  print_removal(why.removal, is_shown);
}

bool is_shown(const MapArchive& archive, ObjectId id) {
  return std::ranges::binary_search(confirmed_ids_of(archive), id);
}

std::string place_text(const PlanPoint& at) {
  std::string text = fixed(at.xy.x(), 3) + " " + fixed(at.xy.y(), 3);
  return at.z ? text + " " + fixed(*at.z, 3) : text;
}

std::string space_text(const std::string& space) {
  if (space == "Unknown") return "unknown: no frame measured anything there";
  if (space == "Free") return "free: frames looked through it";
  if (space == "Occupied") return "occupied, and no shown object has it";
  return "occupied by a " + printable(space);
}

std::string label_of(const MapArchive& archive, ObjectId id) {
  return name_of(explain(archive.objects, id).value(), archive.classes);
}

/// That no withheld object is there, and which one is the nearest, since a box is around what was
/// seen of an object alone.
std::string nothing_withheld_text(const PlaceExplanation& place,
                                  const MapArchive& archive,
                                  const ShownRules& rules) {
  const std::optional<NearestObject>& nearest = place.nearest_withheld;
  if (!nearest) return "nothing: the map tracks no other object";
  const Explanation why =
      explain(archive.objects, nearest->id, rules.confirmation, rules.absence).value();
  return "nothing there; the nearest is " + label_of(archive, nearest->id) + ", " +
         fixed(nearest->distance_m, 2) + " m from its box: " + withheld_text(why.missed_conditions);
}

void print_place(const PlaceExplanation& place,
                 const MapArchive& archive,
                 const ShownRules& rules,
                 const PlanPoint& at) {
  const auto label = [&](ObjectId id) { return label_of(archive, id); };
  for (const ObjectId id : place.shown) {
    std::printf("%s is shown at %s\n", label(id).c_str(), place_text(at).c_str());
  }
  if (place.shown.empty()) std::printf("no object is shown at %s\n", place_text(at).c_str());
  if (place.space) print_line("space", space_text(*place.space));
  if (place.nearest && place.shown.empty()) {
    print_line(
        "nearest",
        label(place.nearest->id) + ", " + fixed(place.nearest->distance_m, 2) + " m from its box");
  }
  if (place.withheld.empty() && place.shown.empty())
    print_line("withheld", nothing_withheld_text(place, archive, rules));
  for (const Explanation& why : place.withheld) print_object(why, archive, false);
}

}  // namespace

Result<void> print_why(const MapArchive& archive, ObjectId id, bool json) {
  const ShownRules rules = rules_of(archive);
  const auto why = explain(archive.objects, id, rules.confirmation, rules.absence);
  if (!why) {
    return fail(ErrorCode::kNotFound, "the map has no object " + std::to_string(id.value), "--why");
  }
  const bool shown = is_shown(archive, id);
  if (json) {
    std::printf("%s\n", json_text(*why, archive, shown).c_str());
  } else {
    print_object(*why, archive, shown);
  }
  return {};
}

Result<void> print_why_not(const MapArchive& archive, const PlanPoint& at, bool json) {
  const ShownRules rules = rules_of(archive);
  HYPERMAP_ASSIGN_OR_RETURN(const PlaceExplanation place,
                            explain_place(archive, at, rules.confirmation, rules.absence));
  if (json) {
    std::printf("%s\n", json_text(place, archive, at).c_str());
  } else {
    print_place(place, archive, rules, at);
  }
  return {};
}

}  // namespace hypermap::app
