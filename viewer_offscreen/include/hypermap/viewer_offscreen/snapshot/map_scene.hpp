// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image shows of a map, wherever the map lives: in an archive or in a running mapper.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/vocabulary/name_selection.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#include <span>

namespace hypermap {

/// What the hypermap's layers draw (`with_layer`), the voxels, and each of `objects` with its box
/// the name of its best class and its id; every part may be empty. The title is left empty.
///
/// `frame_id` is the frame of voxels and objects, which becomes that of the scene.
/// Boundary: a layer of a frame that nothing connects with it is among `left_out`.
/// Requires: what `leaves` looks at outlives the scene. Cost: a copy of grid, shapes and classes.
[[nodiscard]] SnapshotScene map_scene(const Hypermap& hypermap,
                                      const ClassRegistry& classes,
                                      std::span<const Object* const> objects,
                                      LeafSource leaves,
                                      std::string frame_id = "map");

/// The scene with those of its objects and shapes that bear one of the names. Voxels of other
/// classes stay, without a class; what layers draw besides stays as it is.
[[nodiscard]] SnapshotScene only_named(SnapshotScene scene, const NameSelection& names);

}  // namespace hypermap
