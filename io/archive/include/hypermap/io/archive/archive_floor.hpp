// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the floor of a map lies.
#pragma once

#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <optional>
#include <string>

namespace hypermap {

/// The height of the floor that is stated; else of the one that the octree shows in the largest
/// region of the map (`floor_surface_m`); none where neither is. Unit: metre. Frame: Map.
/// Cost: that of MapRegions::find and floor_surface_m; none for a floor that is stated.
[[nodiscard]] std::optional<double> known_floor_m(const MapArchive& archive);

/// The floor that is stated; else the one that the `leaves` of the octree show, unless it is
/// within a voxel and a half of one that is assumed; else the one that the map has.
///
/// Boundary: a floor that is assumed and shown at its place stays at its exact height; one that was
/// found and is shown no longer stays. Requires: archive.octree. Cost: that of floor_surface_m.
[[nodiscard]] MapFloor shown_floor(const MapArchive& archive, const LeafSource& leaves);

/// The floor of two maps in one frame, of which `map` is the sum: what `map` states; what `added`
/// states, where `map` shows no other; what `map` shows; what `added` shows; what `map` assumes.
/// Cost: that of known_floor_m for each.
[[nodiscard]] MapFloor merged_floor(const MapArchive& map, const MapArchive& added);

/// How much higher the floor of `added` lies than that of `map`, where both are known and more than
/// two voxels apart. Unit: metre. Requires: map.octree. Cost: as merged_floor.
[[nodiscard]] std::optional<double> floors_apart_m(const MapArchive& map, const MapArchive& added);

/// "at z = -1.320 m, as found", for people.
[[nodiscard]] std::string text_of(const MapFloor& floor);

}  // namespace hypermap
