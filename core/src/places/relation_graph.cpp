// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relations.hpp"

#include <algorithm>

namespace hypermap {

std::string_view name_of(RelationKind kind) noexcept {
  switch (kind) {
    case RelationKind::kOn:
      return "on";
    case RelationKind::kIn:
      return "in";
    case RelationKind::kUnder:
      return "under";
    case RelationKind::kBeside:
      return "beside";
    case RelationKind::kPartOf:
      break;
  }
  return "part of";
}

std::string_view key_of(RelationKind kind) noexcept {
  return kind == RelationKind::kPartOf ? "part_of" : name_of(kind);
}

std::string_view name_of(RelationSource source) noexcept {
  return source == RelationSource::kPoints ? "points" : "boxes";
}

std::string_view name_of(SupportKind kind) noexcept {
  switch (kind) {
    case SupportKind::kObject:
      return "object";
    case SupportKind::kHolder:
      return "holder";
    case SupportKind::kWhole:
      return "whole";
    case SupportKind::kFloor:
      return "floor";
    case SupportKind::kUnknown:
      break;
  }
  return "unknown";
}

std::vector<std::pair<std::string_view, double>> measures_of(const RelationEvidence& evidence) {
  std::vector<std::pair<std::string_view, double>> measures;
  const auto add = [&](std::string_view name, const std::optional<double>& value) {
    if (value) measures.emplace_back(name, *value);
  };
  add("plan_share", evidence.plan_share);
  add("gap_m", evidence.gap_m);
  add("contact_height_m", evidence.contact_height_m);
  add("inside_share", evidence.inside_share);
  add("contact_share", evidence.contact_share);
  return measures;
}

std::vector<Relation> relations_of(const RelationGraph& graph, ObjectId id) {
  std::vector<Relation> own;
  for (const Relation& relation : graph.relations) {
    const bool is_symmetric = relation.kind == RelationKind::kBeside;
    if (relation.subject == id || (is_symmetric && relation.object == id)) own.push_back(relation);
  }
  return own;
}

std::vector<ObjectId> subjects_of(const RelationGraph& graph, RelationKind kind, ObjectId object) {
  std::vector<ObjectId> ids;
  for (const Relation& relation : graph.relations) {
    if (relation.kind != kind) continue;
    if (relation.object == object) ids.push_back(relation.subject);
    if (kind == RelationKind::kBeside && relation.subject == object) ids.push_back(relation.object);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::optional<ObjectSupport> support_of(const RelationGraph& graph, ObjectId id) {
  const auto found = std::ranges::lower_bound(graph.supports, id, {}, &ObjectSupport::id);
  if (found == graph.supports.end() || found->id != id) return std::nullopt;
  return *found;
}

}  // namespace hypermap
