// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Objects that turn out to be one.
#pragma once

#include "overlap.hpp"
#include "policies.hpp"

#include <map>
#include <set>

namespace hypermap {

/// Point sets of objects, each made once per state of the object.
class PointSetCache {
 public:
  PointSetCache(const ObjectMap& objects, double near_m) : objects_(objects), near_m_(near_m) {}

  const PointSet& of(ObjectId id);
  void forget(ObjectId id) { point_sets_.erase(id); }

 private:
  const ObjectMap& objects_;
  double near_m_;
  std::map<ObjectId, PointSet> point_sets_;
};

/// Merges each of the objects that have `changed` with those that overlap it like one by
/// `merge_factor`, until none does; two that frames showed beside each other stay two. Besides with
/// those that touch it, by twice `near_m`, and are parts of one by when each was detected
/// (`AssignmentOptions::hidden_part_detections`).
/// Cost: an overlap for each neighbour of a changed object.
void merge_duplicates(AssociationRun& run, PointSetCache& point_sets, std::set<ObjectId> changed);

}  // namespace hypermap
