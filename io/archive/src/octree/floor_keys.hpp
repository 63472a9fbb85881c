// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The height of a map's floor as keys of its octree's extension, or its objects' without one.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/core/geometry/map_floor.hpp"

#include <vector>

namespace hypermap {

/// `floor_m` and `floor_source` (assumed, found, stated); where both are absent the floor is
/// assumed at z = 0. Errors: kMalformedFile naming key and line.
[[nodiscard]] Result<MapFloor> floor_of_keys(const ValueTree& extra);

/// None of a floor that is assumed at z = 0.
[[nodiscard]] std::vector<ValueTree::Entry> floor_keys(const MapFloor& floor);

/// The keys of `extra` that are none of these.
[[nodiscard]] ValueTree without_floor_keys(const ValueTree& extra);

}  // namespace hypermap
