// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The floor of a map without what stands on it.
///
/// Source: [smap] F.6 (occupancy grid with the obstacles removed, figure F.6.9).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"

#include <cstdint>

namespace hypermap {

/// Whether cells that objects meet, but do not cover by half, are free, too (`without_rims`).
enum class ObjectRims : std::uint8_t {
  kStay,  ///< For rooms: what stands at a wall may be one.
  kGo,    ///< For who wants to see the floor.
};

/// An occupancy grid of the map with the cells free that a shape of the layer `semantic` covers by
/// half: walls stay, furniture goes. Without that layer, or with none but small objects in it, the
/// grid as it is.
///
/// Requires: `occupancy` is a layer of the map with an OccupancyLayer. Errors: kUnsupported naming
/// both frames when the two layers are in different ones. Cost: the cells that shapes cover.
[[nodiscard]] Result<OccupancyLayer> without_objects(const MapArchive& archive,
                                                     const Layer& occupancy,
                                                     ObjectRims rims = ObjectRims::kStay);

}  // namespace hypermap
