// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether what a map says of what stands on what is true.
#pragma once

#include "hypermap/core/places/relations.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>

namespace hypermap {

/// Relations of one kind. Ratios are none when they would divide by 0.
struct RelationCounts {
  std::size_t right = 0;      ///< That map and truth have.
  std::size_t num_map = 0;    ///< Of the map, between objects that are true.
  std::size_t num_truth = 0;  ///< True ones, between objects that the map has.

  [[nodiscard]] std::optional<double> precision() const;
  [[nodiscard]] std::optional<double> recall() const;
  friend bool operator==(const RelationCounts&, const RelationCounts&) = default;
};

struct RelationEvaluation {
  std::array<RelationCounts, kRelationKinds.size()> counts = {};  ///< In their order.

  [[nodiscard]] RelationCounts& of(RelationKind kind) {
    return counts[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] const RelationCounts& of(RelationKind kind) const {
    return counts[static_cast<std::size_t>(kind)];
  }
  friend bool operator==(const RelationEvaluation&, const RelationEvaluation&) = default;
};

/// Compares the relations of a map with the true ones, by kind and both ends; beside in either
/// direction. Relations are judged, not objects: those with an end that is no match count nowhere.
///
/// `truth_of`: the true object of an object of the map. Requires: no two have the same.
/// Cost: O(n log n).
[[nodiscard]] RelationEvaluation evaluate_relations(std::span<const Relation> map,
                                                    std::span<const Relation> truth,
                                                    const std::map<ObjectId, ObjectId>& truth_of);

}  // namespace hypermap
