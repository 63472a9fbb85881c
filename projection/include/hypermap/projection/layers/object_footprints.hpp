// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects of the map, seen from above, as a semantic layer.
///
/// Source: [hypermap] 3.4.5 (shape `best`, shape `hull`); `voxels` is ours, and so is carving.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// The map that objects stand in, each leaf with its owner.
struct CarvingMap {
  LeafSource leaves;
  double leaf_edge_m =
      0.0;  ///< Of the smallest leaves; others: doubled some times, on its lattice.
};

struct FootprintOptions {
  ShapePolicy policy = ShapePolicy::kVoxels;
  ObjectConfidenceOptions confidence = {};
  /// With it, shapes by policy `voxels` lack what sensors looked through and where other objects
  /// stand; without, they are convex.
  std::optional<CarvingMap> carving = std::nullopt;
};

struct FootprintLayer {
  SemanticLayer layer;
  std::vector<ObjectId> from_box = {};  ///< Had no evidence of the asked kind: their box stands in.
  std::vector<ObjectId> left_out = {};  ///< Never named, or without any extent.
};

/// One entry per object: its id, the name of its best class, its shape, and how sure the map is of
/// it, as confidence of the one tag that is its class. Requires: objects have different ids, and
/// their classes are of the registry. Errors: kInvalidArgument when the requirement is broken;
/// kLimit beyond SemanticLayer::kMaxObjects.
[[nodiscard]] Result<FootprintLayer> project_footprints(std::span<const Object* const> objects,
                                                        const ClassRegistry& classes,
                                                        const FootprintOptions& options = {});

}  // namespace hypermap
