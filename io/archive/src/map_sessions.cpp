// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_sessions.hpp"

#include "hypermap/io/codec/time_text.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

namespace hypermap {
namespace {

using Runs = std::vector<const Provenance*>;

Runs runs_alone(std::span<const Provenance> all) {
  Runs runs;
  for (const Provenance& one : all) {
    if (!is_import(one)) runs.push_back(&one);
  }
  return runs;
}

/// Runs of before frames were counted on do not say where they end.
std::optional<std::uint64_t> end_of(const Runs& runs, std::size_t i) {
  if (i + 1 == runs.size()) return FrameRange{}.end;
  const std::uint64_t next = runs[i]->next_frame_index;
  return next > 0 ? std::optional(next) : std::nullopt;
}

std::optional<FrameRange> frames_of(const Runs& runs, std::size_t i) {
  const auto first = i == 0 ? std::optional<std::uint64_t>(0) : end_of(runs, i - 1);
  const auto end = end_of(runs, i);
  if (!first || !end) return std::nullopt;
  return FrameRange{.first = *first, .end = *end};
}

}  // namespace

bool is_import(const Provenance& provenance) {
  const ValueTree* import = provenance.options.find("import");
  return import != nullptr && import->kind == ValueKind::kMap;
}

std::vector<MapSession> sessions_of(std::span<const Provenance> provenance) {
  const Runs runs = runs_alone(provenance);
  std::vector<MapSession> sessions;
  sessions.reserve(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    sessions.push_back({.number = i + 1,
                        .name = runs[i]->session,
                        .input = runs[i]->input,
                        .first = runs[i]->first_stamp,
                        .last = runs[i]->last_stamp,
                        .frames = frames_of(runs, i)});
  }
  return sessions;
}

std::string name_of(const MapSession& session) {
  return session.name.empty() ? std::to_string(session.number) : session.name;
}

std::string to_string(const MapSession& session) {
  std::string text = name_of(session);
  if (!session.first || !session.last) return text;
  return text + " (" + seconds_text(*session.first) + " .. " + seconds_text(*session.last) + " s)";
}

std::string to_string(std::span<const MapSession> sessions) {
  std::string text;
  for (const MapSession& session : sessions) {
    text.append(text.empty() ? "" : ", ").append(to_string(session));
  }
  return text;
}

Result<MapSession> find_session(std::span<const Provenance> runs, std::string_view name) {
  const std::vector<MapSession> sessions = sessions_of(runs);
  const auto found = std::find_if(sessions.rbegin(), sessions.rend(), [&](const MapSession& one) {
    return name_of(one) == name;
  });
  if (found != sessions.rend()) return *found;
  const std::string known =
      sessions.empty() ? "it does not tell of any" : "it has " + to_string(sessions);
  return fail(ErrorCode::kNotFound,
              "the map has no session '" + printable(name) + "'; " + known,
              "session");
}

std::vector<std::string> names_of_several(std::span<const MapSession> sessions) {
  std::map<std::string, std::size_t> counts;
  for (const MapSession& one : sessions) {
    if (!one.name.empty()) ++counts[one.name];
  }
  std::vector<std::string> names;
  for (const auto& [name, count] : counts) {
    if (count > 1) names.push_back(name);
  }
  return names;
}

std::optional<MapSession> session_of_frame(std::span<const MapSession> sessions,
                                           std::uint64_t frame_index) {
  const auto found = std::ranges::find_if(sessions, [&](const MapSession& one) {
    return one.frames && one.frames->contains(frame_index);
  });
  if (found == sessions.end()) return std::nullopt;
  return *found;
}

bool follow_each_other(std::span<const MapSession> sessions) {
  const auto begins_before_end = [](const MapSession& a, const MapSession& b) {
    return a.last && b.first && *b.first < *a.last;
  };
  return std::ranges::adjacent_find(sessions, begins_before_end) == sessions.end();
}

}  // namespace hypermap
