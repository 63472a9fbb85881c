// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map as it was between two frames.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstdint>
#include <memory>

namespace hypermap {

/// All that a SemanticMapper knew when a frame was complete. It never changes.
///
/// Memory: what the map has written since, and nothing else; it is given back when the last owner
/// lets go, in whatever thread that is.
/// Threads: any number may read one snapshot, or copy its octree, objects and topological map to
/// change the copies.
struct MapSnapshot {
  SemanticOctree octree;
  ObjectMap objects;
  TopologicalMap topological_map;  ///< The places that the sensor had come to then.
  /// As it stood at the last `SemanticMapper::set_classes` before; never null.
  std::shared_ptr<const ClassRegistry> classes;
  /// Frames that the mapper has integrated, those before the snapshot; 0: none yet, and the two
  /// below say nothing.
  std::uint64_t num_frames = 0;
  std::uint64_t frame_index = 0;  ///< `RgbdFrame::index` of the newest one.
  Stamp stamp;                    ///< Of the newest one.
};

}  // namespace hypermap
