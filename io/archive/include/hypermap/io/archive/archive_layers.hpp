// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Everything in an archive that can be asked and drawn, as layers of one kind: its hypermap's
/// layers, the octree, the objects, the class grids.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/hypermap.hpp"

#include <string_view>
#include <vector>

namespace hypermap {

/// The name by which the objects of the 3D map can always be asked.
inline constexpr std::string_view kObjectsLayer = "objects";

/// The name by which the octree can be asked for what each voxel's own belief says, before objects:
/// the raw evidence, of false alarms too.
inline constexpr std::string_view kEvidenceLayer = "evidence";

/// The name by which the topological map can be asked and drawn, where there is one.
inline constexpr std::string_view kTopologicalMapLayer = "topological_map";

/// The layers of the hypermap, then the octree, octrees of other programs, the objects that the map
/// shows (if there are any objects), the class grids, which bear the names of their classes.
///
/// `info`, `query` and `snapshot` know a map by this list alone.
/// Requires: the archive outlives the layers and is not changed.
[[nodiscard]] std::vector<Layer> archive_layers(const MapArchive& archive);

/// The first of these of that name, else of a spelling of it; kObjectsLayer is there in every
/// archive, kEvidenceLayer in every one that has an octree, kTopologicalMapLayer where there is
/// one. Errors: kNotFound, naming those that
/// there are.
[[nodiscard]] Result<Layer> archive_layer(const MapArchive& archive, std::string_view name);

}  // namespace hypermap
