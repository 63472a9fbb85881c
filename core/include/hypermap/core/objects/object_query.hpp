// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects are of a class, at a place, in an area, nearest to a point.
///
/// Source: [hypermap] 3.3.1 (spatial, keyword and combined queries).
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/geometry/plan_point.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/vocabulary/name_selection.hpp"

#include <optional>
#include <vector>

namespace hypermap {

/// Conditions that must all hold; those that are absent always do. Frame: Map.
struct ObjectQuery {
  /// The best class is one of these; an unknown name fits nothing.
  std::optional<NameSelection> class_name = std::nullopt;
  std::optional<ObjectId> id = std::nullopt;
  std::optional<PlanPoint> at = std::nullopt;  ///< In the box, faces included.
  std::optional<Polygon> area = std::nullopt;  ///< Meets the box seen from above, edges included.
  /// One of these, as `published` lists them. Requires: ascending.
  std::optional<std::vector<ObjectId>> among = std::nullopt;
};

/// The objects that fulfil the query, in ascending order of ids.
/// Boundary: an empty list is a normal answer. Cost: O(n).
[[nodiscard]] std::vector<ObjectId> find_objects(const ObjectMap& objects,
                                                 const ClassRegistry& classes,
                                                 const ObjectQuery& query);

/// Those whose best class is one of these.
[[nodiscard]] std::vector<ObjectId> objects_of_class(const ObjectMap& objects,
                                                     const ClassRegistry& classes,
                                                     const NameSelection& class_names);

/// Of the objects that fulfil the query the one whose centroid is nearest to `point`, measured in
/// the plane when `point` has no height; of equally near ones the lowest id. Cost: O(n).
[[nodiscard]] std::optional<ObjectId> nearest_object(const ObjectMap& objects,
                                                     const ClassRegistry& classes,
                                                     const ObjectQuery& query,
                                                     const PlanPoint& point);

}  // namespace hypermap
