// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query` says of another time than now, beside what it found.
#pragma once

#include "hypermap/io/archive/map_history.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "time_arguments.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap::app {

/// The time that was asked for, and what the map tells of it.
struct ShownPast {
  AskedTime asked;
  PastMap past;
  std::vector<std::string> not_kept;  ///< Names of what the map does not keep through time.
  /// Objects that would be among the answers if it could be told (`PastMap::unknown`).
  std::vector<MapAnswer> unknown = {};
};

/// Errors: those of past_of.
[[nodiscard]] Result<ShownPast> shown_past(const MapArchive& archive, const AskedTime& asked);

/// The objects of which it cannot be told whether they are an answer to the question, wherever they
/// are with `anywhere`. Errors: those of query_map.
[[nodiscard]] Result<std::vector<MapAnswer>> unknown_answers(const PastMap& past,
                                                             MapQuery query,
                                                             bool anywhere);

/// Errors: kNotFound when the object had not been seen by then, or when it cannot be told what was
/// believed of it; `archive` is the whole map.
[[nodiscard]] Result<void> check_known_then(const ShownPast& shown,
                                            const MapArchive& archive,
                                            ObjectId id);

/// Seconds of the first and the last detection of an object, of the last one by that time; "-" of
/// no object, and where the log no longer keeps it.
[[nodiscard]] std::string first_seen_text(const ShownPast& shown, std::uint64_t id);
[[nodiscard]] std::string last_seen_text(const ShownPast& shown, std::uint64_t id);

/// Adds both as `first_seen_s` and `last_seen_s`, null where it is not kept. `shown`: null when it
/// is asked for now.
void add_seen(nlohmann::ordered_json& entry, const Object& object, const ShownPast* shown);

/// Adds what was asked for, what is not kept and what cannot be told.
void add_past(nlohmann::ordered_json& json, const ShownPast& shown);

/// The same for people, a line each.
[[nodiscard]] std::string past_text(const ShownPast& shown);

}  // namespace hypermap::app
