// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/related_query.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/objects/object_query.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
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

/// The objects of the graph that `name` means. Errors: kNotFound.
Result<std::vector<ObjectId>> objects_named(const MapArchive& archive,
                                            const RelationGraph& graph,
                                            const std::string& name,
                                            RelationKind kind) {
  const std::string field(key_of(kind));
  if (const auto id = id_in(name)) {
    if (support_of(graph, *id)) return std::vector<ObjectId>{*id};
    return fail(ErrorCode::kNotFound, "no object has the id " + name, field);
  }
  std::vector<ObjectId> ids;
  for (const ObjectId id : objects_of_class(archive.objects, archive.classes, name)) {
    if (support_of(graph, id)) ids.push_back(id);
  }
  if (!ids.empty()) return ids;
  const std::string hint =
      archive.classes.find(name) ? "" : did_you_mean(name, classes_in(archive, graph));
  return fail(ErrorCode::kNotFound, "no object of class '" + printable(name) + "'" + hint, field);
}

}  // namespace

Result<MapAnswers> query_related(const MapArchive& archive,
                                 const RelationGraph& graph,
                                 const RelatedTo& related,
                                 const MapQuery& query) {
  MapQuery of_objects = query;
  of_objects.layer = kObjectsLayer;
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(archive, of_objects));
  for (const auto& [kind, name] : related) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto others, objects_named(archive, graph, name, kind));
    std::set<std::uint64_t> subjects;
    for (const ObjectId other : others) {
      for (const ObjectId id : subjects_of(graph, kind, other)) subjects.insert(id.value);
    }
    std::erase_if(answers.found, [&](const MapAnswer& one) { return !subjects.contains(one.id); });
  }
  return answers;
}

}  // namespace hypermap
