// SPDX-License-Identifier: BSD-3-Clause
#include "commands/completeness.hpp"
#include "commands/query_hints.hpp"
#include "commands/query_text.hpp"
#include "commands/why.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "shell_commands.hpp"
#include "shell_places.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace hypermap::app {
namespace {

Result<const MapArchive*> with_objects(ShellSession& session) {
  return session.map.with({.octrees = false, .objects = true, .class_grids = false});
}

/// A table of objects as `query` prints it.
Result<void> print_objects(const MapArchive& map, const MapQuery& query, const MapAnswers& found) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto seen, completeness_of(map, query, found, false));
  const RelationGraph no_relations;
  print_table({.answers = found, .seen = seen, .archive = map, .graph = no_relations});
  const bool is_nothing_named = found.found.empty() && query.text;
  const auto hint = is_nothing_named ? name_hint(map, query) : std::nullopt;
  if (hint) print_note(*hint);
  return {};
}

}  // namespace

Result<void> do_objects(ShellSession& session, const ShellArguments& words) {
  MapQuery query{.layer = std::string(kObjectsLayer)};
  if (!words.empty()) query.text = joined_words(words, 0);
  query.frame_id = session.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, with_objects(session));
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers found, query_map(*map, query));
  return print_objects(*map, query, found);
}

Result<void> do_nearest(ShellSession& session, const ShellArguments& words) {
  MapQuery query{.text = words[0]};
  HYPERMAP_ASSIGN_OR_RETURN(query.at, parse_location(joined_words(words, 1)));
  query.frame_id = session.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, with_objects(session));
  query.layer = nearest_layer(*map);
  HYPERMAP_ASSIGN_OR_RETURN(const MapAnswers found, query_nearest(*map, query));
  return print_objects(*map, query, found);
}

Result<void> do_why(ShellSession& session, const ShellArguments& words) {
  const auto id = parse_unsigned(words[0]);
  if (!id || *id == 0 || *id > std::numeric_limits<std::uint32_t>::max()) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must be the id of an object, a whole number from 1 on, is '" + printable(words[0]) + "'",
        "ID");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, with_objects(session));
  auto explained = print_why(*map, ObjectId{static_cast<std::uint32_t>(*id)}, false);
  if (!explained) explained.error().field.clear();  // the flag of another command
  return explained;
}

Result<void> do_why_not(ShellSession& session, const ShellArguments& words) {
  HYPERMAP_ASSIGN_OR_RETURN(const PlanPoint at, parse_location(joined_words(words, 0)));
  HYPERMAP_ASSIGN_OR_RETURN(
      const MapArchive* map,
      session.map.with({.octrees = true, .objects = true, .class_grids = false}));
  return print_why_not(*map, at, false);
}

}  // namespace hypermap::app
