// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The association policies; `associate` chooses one.
#pragma once

#include "hypermap/core/objects/association.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// What every policy works on: the map, one frame's observations and the report being written.
struct AssociationRun {
  ObjectMap& objects;
  std::span<const Observation> observations;
  const AssociationOptions& options;
  AssociationReport report;

  /// True when the observation's class is transient, so that it updates no object; counted.
  [[nodiscard]] bool is_transient(std::size_t observation);
  void create(std::size_t observation);
  void match(std::size_t observation, ObjectId id);
  /// Joins two objects; the lower id stays and is returned.
  ObjectId merge(ObjectId a, ObjectId b);
};

void associate_by_assignment(AssociationRun& run);
/// Of cells that an object of this frame and a neighbour both claim, each goes to the one whose
/// observations agree on it more (`contested_factor`). Each pair is settled once.
void settle_contested_cells(AssociationRun& run);
void associate_by_overlap(AssociationRun& run);
void associate_by_radius(AssociationRun& run);
void associate_by_smap(AssociationRun& run, const ObjectScope& scope);

/// The class that an observation names.
[[nodiscard]] ClassId named_class(const Observation& observation);

/// True when the best class of the object is `id`.
[[nodiscard]] bool is_of_class(const Object& object, ClassId id);

}  // namespace hypermap
