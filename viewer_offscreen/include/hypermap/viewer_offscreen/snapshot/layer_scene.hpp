// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image shows of a layer, of whatever type.
#pragma once

#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

namespace hypermap {

/// The scene with what the layer draws. Areas, a grid shaded by occupancy, and voxels are those of
/// the first layer that draws any; boxes, coloured cells, lines and texts are added.
///
/// Boundary: the layer's coordinates are taken as the scene's, which gets the layer's frame.
/// Requires: what drawn voxels look at outlives the scene; scene.classes stands already.
[[nodiscard]] SnapshotScene with_layer(SnapshotScene scene, const Layer& layer);

}  // namespace hypermap
