// SPDX-License-Identifier: BSD-3-Clause
#include "past_text.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"

#include <cstdint>
#include <optional>
#include <utility>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

/// Summed, as nanoseconds since 1970 are no double: the nearest one to the seconds as written.
double in_seconds(Stamp stamp) {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  const std::int64_t whole_s = stamp.ns / kNsPerS;
  const std::int64_t rest_ns = stamp.ns % kNsPerS;
  return static_cast<double>(whole_s) + static_cast<double>(rest_ns) / 1e9;
}

Json seconds_json(const std::optional<Stamp>& stamp) {
  return stamp ? Json(in_seconds(*stamp)) : Json(nullptr);
}

Json seconds_json(const std::optional<WrittenTime>& time) {
  return time ? Json(in_seconds(time->stamp)) : Json(nullptr);
}

/// Of the object as the past map has it; null when it has none of that id.
const Object* object_of(const ShownPast& shown, std::uint64_t id) {
  return shown.past.map.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
}

/// Its newest detection by the time that was asked for, or of all when none ends it.
std::optional<Stamp> last_seen(const Object& object, bool by_log) {
  return by_log ? last_detection(object.observation_log) : std::optional(object.last_seen);
}

/// Of an object that the map does not tell of at the time asked for: since when it tells all.
std::optional<Stamp> told_from(const PastMap& past, std::uint64_t id) {
  const Object* object = past.unknown.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
  return object == nullptr ? std::nullopt : kept_since(object->observation_log);
}

std::optional<Stamp> first_seen_of_unknown(const PastMap& past, std::uint64_t id) {
  const Object* object = past.unknown.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
  return object == nullptr ? std::nullopt : std::optional(object->first_seen);
}

std::string names_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text;
}

std::string unknown_text(const ShownPast& shown) {
  std::string text;
  for (const MapAnswer& one : shown.unknown) {
    text += (text.empty() ? "" : ", ") + printable(one.name) + " " + std::to_string(one.id);
    if (const auto from = told_from(shown.past, one.id))
      text += " (from " + seconds_text(*from) + " s on)";
  }
  return text;
}

}  // namespace

Result<ShownPast> shown_past(const MapArchive& archive, const AskedTime& asked) {
  HYPERMAP_ASSIGN_OR_RETURN(PastMap past, past_of(archive, asked));
  ShownPast shown{.asked = asked, .past = std::move(past), .not_kept = {}};
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.info.name != kSemanticLayer) shown.not_kept.push_back(layer.info.name);
  }
  // Not read for such a question, and the names of class grids are those of classes.
  for (const char* part : {"octrees", "class grids", "topological map"})
    shown.not_kept.emplace_back(part);
  return shown;
}

Result<std::vector<MapAnswer>> unknown_answers(const PastMap& past, MapQuery query, bool anywhere) {
  if (anywhere) query.at.reset();
  if (past.unknown.objects.empty()) return std::vector<MapAnswer>{};
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(past.unknown, query));
  return std::move(answers.found);
}

Result<void> check_known_then(const ShownPast& shown, const MapArchive& archive, ObjectId id) {
  const bool is_known = shown.past.map.objects.contains(id) || !archive.objects.contains(id);
  if (is_known) return {};
  const std::string object = "object " + std::to_string(id.value);
  if (!shown.past.unknown.objects.contains(id))
    return fail(
        ErrorCode::kNotFound, object + " had not been seen " + text_of(shown.asked), "--why");
  const auto from = told_from(shown.past, id.value);
  return fail(ErrorCode::kNotFound,
              "what was believed of " + object + " " + text_of(shown.asked) +
                  " is not kept, its log sums up what came before" +
                  (from ? " " + seconds_text(*from) + " s" : ""),
              "--why");
}

std::string first_seen_text(const ShownPast& shown, std::uint64_t id) {
  const Object* object = object_of(shown, id);
  return object == nullptr ? "-" : seconds_text(object->first_seen);
}

std::string last_seen_text(const ShownPast& shown, std::uint64_t id) {
  const Object* object = object_of(shown, id);
  const auto last =
      object == nullptr ? std::nullopt : last_seen(*object, shown.asked.as_of.has_value());
  return last ? seconds_text(*last) : "-";
}

void add_seen(Json& entry, const Object& object, const ShownPast* shown) {
  const bool by_log = shown != nullptr && shown->asked.as_of.has_value();
  entry["first_seen_s"] = in_seconds(object.first_seen);
  entry["last_seen_s"] = seconds_json(last_seen(object, by_log));
}

void add_past(Json& json, const ShownPast& shown) {
  const AskedTime& asked = shown.asked;
  json["time"] = {{"as_of_s", seconds_json(asked.as_of)},
                  {"since_s", seconds_json(asked.since)},
                  {"until_s", seconds_json(asked.until)},
                  {"session", asked.session ? Json(*asked.session) : Json(nullptr)}};
  json["not_kept"] = shown.not_kept;
  json["classes_of_now"] = shown.past.has_classes_of_now;
  json["unconfirmed"] = shown.past.num_unconfirmed;
  json["unknown"] = Json::array();
  for (const MapAnswer& one : shown.unknown) {
    json["unknown"].push_back(
        {{"id", one.id},
         {"name", one.name},
         {"first_seen_s", seconds_json(first_seen_of_unknown(shown.past, one.id))},
         {"kept_since_s", seconds_json(told_from(shown.past, one.id))}});
  }
}

std::string past_text(const ShownPast& shown) {
  const bool is_moment = shown.asked.as_of.has_value();
  std::string text = text_of(shown.asked) +
                     (is_moment ? ": as believed then, with the shapes of now"
                                : ": detected then, as believed now") +
                     "; not kept through time: " + names_text(shown.not_kept) + "\n";
  if (shown.past.has_classes_of_now)
    text += "names and confidences are those of now: this map's rules keep no others\n";
  if (shown.past.num_unconfirmed > 0) {
    text += count_text(shown.past.num_unconfirmed, "more object") +
            " detected then, not confirmed now: --as-of tells what was believed then\n";
  }
  if (!shown.unknown.empty()) {
    text += count_text(shown.unknown.size(), "object") + " of which it cannot be told, " +
            "as the log only sums up that time: " + unknown_text(shown) + "\n";
  }
  return text;
}

}  // namespace hypermap::app
