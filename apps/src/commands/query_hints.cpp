// SPDX-License-Identifier: BSD-3-Clause
#include "query_hints.hpp"

#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/map_history.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

std::optional<std::string> name_hint(const MapArchive& archive, const MapQuery& query) {
  const std::string& text = *query.text;
  std::vector<std::string> known = names_in(archive);
  if (query.layer == kObjectsLayer) {
    known.assign(archive.classes.names().begin(), archive.classes.names().end());
  }
  const auto names = asked_of_map(archive, text);
  const auto is_asked = [&](const std::string& name) { return names->contains(name); };
  if (!names || std::ranges::any_of(known, is_asked)) return std::nullopt;
  return nothing_asked(text, known, archive.vocabulary, "no class of this map");
}

bool print_hint(const MapArchive& archive, const MapQuery& query) {
  const auto hint = name_hint(archive, query);
  if (hint) std::fprintf(stderr, "query: %s\n", hint->c_str());
  return hint.has_value();
}

void print_no_relation(const QueryArguments& arguments) {
  std::string text = "nothing";
  if (arguments.text) text += " called \"" + printable(*arguments.text) + "\"";
  if (arguments.value) text += " with the id " + std::to_string(*arguments.value);
  if (arguments.at) text += " at " + printable(*arguments.at);
  if (arguments.area) text += " in that area";
  std::string_view between = " that is ";
  for (const auto& [kind, name] : arguments.related) {
    text += std::string(between) + std::string(name_of(kind)) + " " + printable(name);
    between = " and ";
  }
  std::fprintf(stderr, "query: the map knows of %s\n", text.c_str());
}

void print_times_hint(const MapArchive& archive, const AskedTime& asked) {
  const auto times = times_of(archive);
  if (!times) return;
  std::fprintf(stderr,
               "query: nothing was found %s; the map's frames are from %s to %s\n",
               text_of(asked).c_str(),
               dated_text(times->first).c_str(),
               dated_text(times->last).c_str());
}

}  // namespace hypermap::app
