// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether one object is on, in, under, beside another one or a part of it, by the two alone.
#pragma once

#include "hypermap/core/places/relations.hpp"
#include "places/placed_shape.hpp"

#include <optional>

namespace hypermap {

/// Each gives the evidence, or none when the relation does not hold. They know no third object and
/// no class. `a` is the subject. Requires: a.id != b.id.

/// The foot of `a` is at the height of b's top surface around it, and above b's foot.
[[nodiscard]] std::optional<RelationEvidence> on_evidence(const PlacedShape& a,
                                                          const PlacedShape& b,
                                                          const RelationOptions& options);
/// Most of the plan of `a` lies below b's underside, with more than a contact's gap between.
[[nodiscard]] std::optional<RelationEvidence> under_evidence(const PlacedShape& a,
                                                             const PlacedShape& b,
                                                             const RelationOptions& options);
/// Enough of the volume of `a` lies in the larger `b`, to the height that a tenth of its surface
/// reaches: what stands on it, and of which it has some points, is not in it.
[[nodiscard]] std::optional<RelationEvidence> in_evidence(const PlacedShape& a,
                                                          const PlacedShape& b,
                                                          const RelationOptions& options);
/// `a` lies in the larger `b` and has its surface on that of `b`.
[[nodiscard]] std::optional<RelationEvidence> part_evidence(const PlacedShape& a,
                                                            const PlacedShape& b,
                                                            const RelationOptions& options);
/// The footprints are near each other by the smaller one's size, their feet on one level, and
/// neither lies half in the other. Symmetric.
[[nodiscard]] std::optional<RelationEvidence> beside_evidence(const PlacedShape& a,
                                                              const PlacedShape& b,
                                                              const RelationOptions& options);

/// How far from `shape` another one may be beside it, whatever that one is.
[[nodiscard]] double reach_m(const PlacedShape& shape, const RelationOptions& options);

}  // namespace hypermap
