// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/related_query.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/objects/object_query.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/objects_layer.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// A whole number, when the text is one.
std::optional<ObjectId> id_in(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return ObjectId{value};
}

/// The names of the classes that the objects of the graph have, each once.
std::vector<std::string> classes_in(const MapArchive& archive, const RelationGraph& graph) {
  std::set<std::string> names;
  for (const ObjectSupport& one : graph.supports) {
    const auto best = best_class(archive.objects.at(one.id));
    if (best) names.insert(archive.classes.name(best->id));
  }
  return {names.begin(), names.end()};
}

/// kNotFound: no object of the graph is of class `name`.
Unexpected no_object_of(const MapArchive& archive,
                        const RelationGraph& graph,
                        const std::string& name,
                        RelationKind kind) {
  const std::string field(key_of(kind));
  if (is_class_of_map(archive, name)) {
    return fail(ErrorCode::kNotFound, "no object of class '" + printable(name) + "'", field);
  }
  if (is_spelling_of(kFloorName, name)) {
    return fail(
        ErrorCode::kNotFound, "the floor is no object of the map: things are on it alone", field);
  }
  if (archive.vocabulary.knows(name)) {
    return fail(ErrorCode::kNotFound,
                nothing_asked(name, archive.classes.names(), archive.vocabulary),
                field);
  }
  std::vector<std::string> known = classes_in(archive, graph);
  if (kind == RelationKind::kOn) known.emplace_back(kFloorName);
  return fail(
      ErrorCode::kNotFound, nothing_named("class of the map's objects", name, known), field);
}

/// The objects of the graph that `name` means. Errors: kNotFound.
Result<std::vector<ObjectId>> objects_named(const MapArchive& archive,
                                            const RelationGraph& graph,
                                            const std::string& name,
                                            RelationKind kind) {
  if (const auto id = id_in(name)) {
    if (support_of(graph, *id)) return std::vector<ObjectId>{*id};
    return fail(ErrorCode::kNotFound, "no object has the id " + name, std::string(key_of(kind)));
  }
  std::vector<ObjectId> ids;
  auto names = asked_of_map(archive, name);
  if (!names) {
    names.error().field = std::string(key_of(kind));
    return Unexpected(std::move(names).error());
  }
  for (const ObjectId id : objects_of_class(archive.objects, archive.classes, *names)) {
    if (support_of(graph, id)) ids.push_back(id);
  }
  const bool is_floor = kind == RelationKind::kOn && is_spelling_of(kFloorName, name);
  if (ids.empty() && !is_floor) return no_object_of(archive, graph, name, kind);
  return ids;
}

/// The objects that are `kind` to one that `name` means. Errors: kNotFound.
Result<std::set<std::uint64_t>> subjects_named(const MapArchive& archive,
                                               const RelationGraph& graph,
                                               const std::string& name,
                                               RelationKind kind) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto others, objects_named(archive, graph, name, kind));
  std::set<std::uint64_t> subjects;
  for (const ObjectId other : others) {
    for (const ObjectId id : subjects_of(graph, kind, other)) subjects.insert(id.value);
  }
  if (kind != RelationKind::kOn || !is_spelling_of(kFloorName, name)) return subjects;
  for (const ObjectSupport& one : graph.supports) {
    if (one.kind == SupportKind::kFloor) subjects.insert(one.id.value);
  }
  return subjects;
}

/// Relations are those of confirmed objects. Errors: kNotFound, when there is none.
Result<void> require_objects(const MapArchive& archive,
                             const RelationGraph& graph,
                             const RelatedTo& related) {
  if (!graph.supports.empty() || related.empty()) return {};
  return fail(ErrorCode::kNotFound,
              std::string("relations need tracked 3D objects, and the map has none") +
                  (archive.objects.empty() ? "" : " that is confirmed"),
              std::string(key_of(related.begin()->first)));
}

}  // namespace

Result<MapAnswers> query_related(const MapArchive& archive,
                                 const RelationGraph& graph,
                                 const RelatedTo& related,
                                 const MapQuery& query) {
  HYPERMAP_TRY(require_objects(archive, graph, related));
  MapQuery of_objects = query;
  of_objects.layer = kObjectsLayer;
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(archive, of_objects));
  for (const auto& [kind, name] : related) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto subjects, subjects_named(archive, graph, name, kind));
    std::erase_if(answers.found, [&](const MapAnswer& one) { return !subjects.contains(one.id); });
  }
  return answers;
}

}  // namespace hypermap
