// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/relation_evaluation.hpp"

#include <algorithm>
#include <compare>
#include <set>

namespace hypermap {
namespace {

/// A relation between true objects.
struct TrueLink {
  RelationKind kind = RelationKind::kOn;
  ObjectId subject;
  ObjectId object;
  friend auto operator<=>(const TrueLink&, const TrueLink&) = default;
};

TrueLink link_of(RelationKind kind, ObjectId subject, ObjectId object) {
  const bool turns = kind == RelationKind::kBeside && object < subject;
  return turns ? TrueLink{kind, object, subject} : TrueLink{kind, subject, object};
}

std::optional<double> ratio_of(std::size_t part, std::size_t all) {
  if (all == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

std::optional<double> RelationCounts::precision() const {
  return ratio_of(right, num_map);
}

std::optional<double> RelationCounts::recall() const {
  return ratio_of(right, num_truth);
}

RelationEvaluation evaluate_relations(std::span<const Relation> map,
                                      std::span<const Relation> truth,
                                      const std::map<ObjectId, ObjectId>& truth_of) {
  std::set<ObjectId> mapped;
  for (const auto& [own, true_id] : truth_of) mapped.insert(true_id);
  RelationEvaluation evaluation;
  std::set<TrueLink> links;
  for (const Relation& one : truth) {
    if (!mapped.contains(one.subject) || !mapped.contains(one.object)) continue;
    links.insert(link_of(one.kind, one.subject, one.object));
  }
  for (const TrueLink& link : links) ++evaluation.of(link.kind).num_truth;
  for (const Relation& one : map) {
    const auto subject = truth_of.find(one.subject);
    const auto object = truth_of.find(one.object);
    if (subject == truth_of.end() || object == truth_of.end()) continue;
    RelationCounts& counts = evaluation.of(one.kind);
    ++counts.num_map;
    if (links.contains(link_of(one.kind, subject->second, object->second))) ++counts.right;
  }
  return evaluation;
}

}  // namespace hypermap
