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

std::string sentence_of(const RelationGraph& graph,
                        ObjectId id,
                        const ObjectNaming& naming,
                        std::string_view place) {
  std::vector<std::string> parts;
  if (!place.empty()) parts.emplace_back(place);
  const auto support = support_of(graph, id);
  if (support && support->kind == SupportKind::kFloor) parts.emplace_back("on the floor");
  for (const Relation& relation : relations_of(graph, id)) {
    parts.push_back(part_text(relation, id, naming));
  }
  std::string text = naming(id);
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? " is " : ", ") + parts[i];
  if (support && support->kind == SupportKind::kUnknown) {
    text +=
        std::string(parts.empty() ? ": " : "; ") + "what it stands on was not seen or has no class";
  }
  return text;
}

}  // namespace hypermap
