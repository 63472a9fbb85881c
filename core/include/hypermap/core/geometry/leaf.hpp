// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the 3D map hands to those who look at it cell by cell, so that they need not know the
/// octree.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>

namespace hypermap {

/// One known cell of the 3D map.
struct LeafSample {
  Eigen::Vector3d centre_in_map = Eigen::Vector3d::Zero();
  double edge_m = 0.0;
  LogOdds occupancy = {};  ///< Accumulated and clamped.
  bool occupied = false;   ///< By the map's own threshold.
  std::optional<ClassId> best_class =
      {};                       ///< Most probable class; none where nothing was ever named.
  LogOdds class_log_odds = {};  ///< Of `best_class`.
  ObjectId object = kNoObject;  ///< kNoObject where the cell belongs to none.
};

struct LeafCount {
  std::size_t occupied = 0;
  std::size_t free = 0;
  friend bool operator==(const LeafCount&, const LeafCount&) = default;
};

using LeafVisitor = std::function<void(const LeafSample&)>;

/// Calls the visitor for each known cell, in Morton order. Given by whoever owns the map.
using LeafSource = std::function<void(const LeafVisitor&)>;

}  // namespace hypermap
