// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image shows of a layer, of whatever type.
#pragma once

#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

namespace hypermap {

/// The scene with what the layer draws, brought into the scene's frame. Areas, a grid shaded by
/// occupancy, and voxels are those of the first layer that draws any; boxes, coloured cells, lines
/// and texts are added.
///
/// Boundary: boxes and voxels that a frame turns keep the directions of their edges; a box grows to
/// hold the turned one. A layer that `frames` does not connect with the scene is among `left_out`.
/// Requires: what drawn voxels look at outlives the scene; scene.classes stands already.
[[nodiscard]] SnapshotScene with_layer(SnapshotScene scene,
                                       const Layer& layer,
                                       const FrameTree& frames);

}  // namespace hypermap
