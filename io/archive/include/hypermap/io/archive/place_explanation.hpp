// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Why a map shows no object at a place.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/plan_point.hpp"
#include "hypermap/core/objects/explanation.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// An object and how far its box is from a point.
struct NearestObject {
  ObjectId id;
  double distance_m = 0.0;  ///< In the plane when the point has no height.
  friend bool operator==(const NearestObject&, const NearestObject&) = default;
};

/// What a map knows of a point. Objects that it has removed, it no longer knows.
struct PlaceExplanation {
  std::vector<ObjectId> shown;  ///< Objects whose boxes hold it, ascending.
  /// The class of its voxel, or Free, Occupied, Unknown: nothing was ever measured there. None: the
  /// point has no height, or the map no octree.
  std::optional<std::string> space = std::nullopt;
  /// Objects that the map knows, does not show, and whose boxes hold it, ascending.
  std::vector<Explanation> withheld;
  std::optional<NearestObject> nearest = std::nullopt;  ///< None: the map shows no object.
  /// The nearest object that the map knows and does not show, where no box of one holds the point:
  /// a part of what is there, or what is a little off. None: the map withholds no object.
  std::optional<NearestObject> nearest_withheld = std::nullopt;
};

/// `at` is in the frame of the map's objects; the rules as for `explain`. Errors: those of
/// query_map.
[[nodiscard]] Result<PlaceExplanation> explain_place(const MapArchive& archive,
                                                     const PlanPoint& at,
                                                     const ConfirmationOptions& confirmation = {},
                                                     const AbsenceOptions& absence = {});

}  // namespace hypermap
