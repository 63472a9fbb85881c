// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relation_text.hpp"

#include <vector>

namespace hypermap {
namespace {

std::string part_text(const Relation& relation, ObjectId id, const ObjectNaming& naming) {
  const ObjectId other = relation.subject == id ? relation.object : relation.subject;
  return std::string(name_of(relation.kind)) + " " + naming(other);
}

}  // namespace

std::string sentence_of(const RelationGraph& graph, ObjectId id, const ObjectNaming& naming) {
  std::vector<std::string> parts;
  const auto support = support_of(graph, id);
  if (support && support->kind == SupportKind::kFloor) parts.emplace_back("on the floor");
  for (const Relation& relation : relations_of(graph, id)) {
    parts.push_back(part_text(relation, id, naming));
  }
  if (support && support->kind == SupportKind::kUnknown) {
    parts.emplace_back("on no object of the map");
  }
  std::string text = naming(id);
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? " is " : ", ") + parts[i];
  return text;
}

}  // namespace hypermap
