// SPDX-License-Identifier: BSD-3-Clause
#include "commands/query_hints.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "shell_commands.hpp"
#include "shell_places.hpp"
#include "tables.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <set>
#include <system_error>
#include <utility>

namespace hypermap::app {
namespace {

/// Asks the layer, in the session's frame; of an empty answer it is said that it is one.
Result<MapAnswers> ask(ShellSession& session, MapQuery query, const std::string& layer) {
  query.layer = layer;
  query.frame_id = session.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, session.map.for_layer(layer));
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(*map, query));
  if (answers.found.empty()) {
    const auto hint = query.text ? name_hint(*map, query) : std::nullopt;
    print_note(hint.value_or("nothing found"));
  }
  return answers;
}

Result<std::int64_t> parse_value(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && parsed == end) return value;
  return fail(ErrorCode::kInvalidArgument,
              "must be a whole number, is '" + printable(text) + "'",
              "INTEGER");
}

/// The names of all answers, each once, in the order of the answers.
void print_names(const MapAnswers& answers) {
  std::set<std::string> listed;
  for (const MapAnswer& one : answers.found) {
    if (listed.insert(one.name).second) std::printf("%s\n", printable(one.name).c_str());
  }
}

/// The integers of all answers, each once, ascending.
void print_values(const MapAnswers& answers) {
  std::set<std::int64_t> values;
  for (const MapAnswer& one : answers.found) values.insert(one.value);
  for (const std::int64_t value : values) std::printf("%lld\n", static_cast<long long>(value));
}

/// "X Y", with a height where the layer has any.
void print_positions(const MapAnswers& answers) {
  for (const MapAnswer& one : answers.found) {
    std::string text = fixed(one.position.xy.x(), 3) + " " + fixed(one.position.xy.y(), 3);
    if (one.position.z) text += " " + fixed(*one.position.z, 3);
    std::printf("%s\n", text.c_str());
  }
}

/// Asks what is at a location or in an area and prints it by `print`.
template <class Print>
Result<void> tell_at(ShellSession& session, const ShellArguments& words, const Print& print) {
  HYPERMAP_ASSIGN_OR_RETURN(const PlanPoint at, parse_location(joined_words(words, 1)));
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers answers, ask(session, {.at = at}, words[0]));
  print(answers);
  return {};
}

template <class Print>
Result<void> tell_within(ShellSession& session, const ShellArguments& words, const Print& print) {
  HYPERMAP_ASSIGN_OR_RETURN(Polygon area, parse_shell_area(joined_words(words, 1)));
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers answers,
                            ask(session, {.area = std::move(area)}, words[0]));
  print(answers);
  return {};
}

/// Prints where that is which fulfils `query`.
Result<void> tell_where(ShellSession& session, MapQuery query, const std::string& layer) {
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers answers, ask(session, std::move(query), layer));
  print_positions(answers);
  return {};
}

}  // namespace

Result<void> do_string(ShellSession& session, const ShellArguments& words) {
  return tell_at(session, words, print_names);
}

Result<void> do_strings(ShellSession& session, const ShellArguments& words) {
  return tell_within(session, words, print_names);
}

Result<void> do_int(ShellSession& session, const ShellArguments& words) {
  return tell_at(session, words, print_values);
}

Result<void> do_ints(ShellSession& session, const ShellArguments& words) {
  return tell_within(session, words, print_values);
}

Result<void> do_coords(ShellSession& session, const ShellArguments& words) {
  return tell_where(session, {.text = joined_words(words, 1)}, words[0]);
}

Result<void> do_coords_area(ShellSession& session, const ShellArguments& words) {
  HYPERMAP_ASSIGN_OR_RETURN(Polygon area, parse_shell_area(joined_words(words, 2)));
  return tell_where(session, {.text = words[1], .area = std::move(area)}, words[0]);
}

Result<void> do_int_coords(ShellSession& session, const ShellArguments& words) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value, parse_value(words[1]));
  return tell_where(session, {.value = value}, words[0]);
}

Result<void> do_int_coords_area(ShellSession& session, const ShellArguments& words) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value, parse_value(words[1]));
  HYPERMAP_ASSIGN_OR_RETURN(Polygon area, parse_shell_area(joined_words(words, 2)));
  return tell_where(session, {.value = value, .area = std::move(area)}, words[0]);
}

}  // namespace hypermap::app
