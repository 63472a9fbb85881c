// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relation_text.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

ObjectId other_of(const Relation& relation, ObjectId id) {
  return relation.subject == id ? relation.object : relation.subject;
}

/// What is beside it with the least gap, `id` apart: of several tables it tells which.
std::optional<ObjectId> landmark_of(const RelationGraph& graph, ObjectId holder, ObjectId id) {
  std::optional<ObjectId> nearest;
  double least_gap_m = std::numeric_limits<double>::infinity();
  for (const Relation& relation : relations_of(graph, holder)) {
    const ObjectId other = other_of(relation, holder);
    if (relation.kind != RelationKind::kBeside || other == id) continue;
    const double gap_m = relation.evidence.gap_m.value_or(least_gap_m);
    if (nearest && !(gap_m < least_gap_m)) continue;
    nearest = other;
    least_gap_m = gap_m;
  }
  return nearest;
}

std::string part_text(const RelationGraph& graph,
                      const Relation& relation,
                      ObjectId id,
                      const ObjectNaming& naming) {
  const ObjectId other = other_of(relation, id);
  std::string text = std::string(name_of(relation.kind)) + " " + naming(other);
  if (relation.kind == RelationKind::kBeside || relation.subject != id) return text;
  if (const auto landmark = landmark_of(graph, other, id)) text += " by " + naming(*landmark);
  return text;
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
    parts.push_back(part_text(graph, relation, id, naming));
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
