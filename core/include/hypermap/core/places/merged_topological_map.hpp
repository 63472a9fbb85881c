// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The places and ways that two sensors came by, as one graph.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/topological_map.hpp"

namespace hypermap {

/// The graphs of both, the vertices of `added` after those of `map`, joined where their ways meet:
/// each path vertex of `added` with the nearest one of `map`, if the edge is not too long and the
/// way is free. So the three rules of a topological map hold, as they did of each. The sensor is
/// where that of `added` is, or of `map` where that one says nothing.
///
/// Frame: Map, the same for both. Errors: kInvalidArgument when their options differ.
/// Cost: for each path vertex of `added` a look at the vertices around it.
[[nodiscard]] Result<TopologicalMap> merged(const TopologicalMap& map,
                                            const TopologicalMap& added,
                                            const IsWayFree& is_free);

}  // namespace hypermap
