// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The topological map of a map in tiles: what tiles have of it, and as one again.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/io/jobs/split_job.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace hypermap {

/// The ways from tile to tile, in the order of the edges. Requires: the regions divide the plane,
/// and each part was cut by `cropped`, which keeps the order of vertices.
/// Cost: each vertex is looked for in each region.
[[nodiscard]] std::vector<TileWay> ways_between(const TopologicalMap& places,
                                                std::span<const CropRegion> regions);

/// Without the vertices behind the first `num_own`, and their ways.
/// Errors: kMalformedFile naming `vertices` when there are fewer.
[[nodiscard]] Result<TopologicalMap> own_places(const TopologicalMap& places, std::size_t num_own);

/// With those ways whose tiles are both there, by the number of each tile's first vertex.
/// Errors: those of TopologicalMap::create.
[[nodiscard]] Result<TopologicalMap> with_ways(
    const TopologicalMap& places,
    std::span<const TileWay> ways,
    const std::map<std::size_t, std::size_t>& first_vertex_of_tile);

}  // namespace hypermap
