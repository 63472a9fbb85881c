// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Guesses of how large the objects of a map are that it saw from few sides.
#pragma once

#include "hypermap/core/completion/completion.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <map>

namespace hypermap {

/// `completed_box` of the confirmed objects that have one, by the usual sizes of the confirmed
/// objects and the free space of the octree. Without an octree no space is known to be free.
/// Frame: that of the objects. Cost: a footprint a confirmed object, and the guesses.
[[nodiscard]] std::map<ObjectId, Box> completed_boxes(const MapArchive& archive);

}  // namespace hypermap
