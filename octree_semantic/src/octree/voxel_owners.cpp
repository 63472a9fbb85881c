// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include "hypermap/core/objects/object.hpp"

#include <utility>

namespace hypermap {
namespace {

/// A surface is measured so much before or behind where it is.
constexpr double kSurfaceNoiseM = 0.05;

}  // namespace

VoxelOwners::VoxelOwners(const ObjectMap& objects, std::span<const ObjectId> confirmed) {
  owners_.reserve(confirmed.size());
  for (const ObjectId id : confirmed) {
    const Object* object = objects.find(id);
    const auto best = object != nullptr ? best_class(*object) : std::nullopt;
    if (!best) continue;
    owners_.emplace(id, Owner{OwnerLabel{best->id, LogOdds::of(object_confidence(*object))},
                               grown(object->box, kSurfaceNoiseM)});
  }
}

const OwnerLabel* VoxelOwners::find(ObjectId object,
                                    const Eigen::Vector3d& centre_in_map,
                                    double edge_m) const {
  if (object == kNoObject) return nullptr;
  const auto found = owners_.find(object);
  if (found == owners_.end()) return nullptr;
  const bool reaches = grown(found->second.bounds, 0.5 * edge_m).contains(centre_in_map);
  return reaches ? &found->second.label : nullptr;
}

LeafSample VoxelOwners::owned(const LeafSample& leaf) const {
  LeafSample shown = leaf;
  const OwnerLabel* owner = find(leaf.object, leaf.centre_in_map, leaf.edge_m);
  shown.object = owner == nullptr ? kNoObject : leaf.object;
  shown.best_class = owner == nullptr ? std::nullopt : std::optional(owner->class_id);
  shown.class_log_odds = owner == nullptr ? LogOdds() : owner->probability;
  return shown;
}

LeafSource owned_leaves(const SemanticOctree& octree, VoxelOwners owners) {
  return [leaves = leaf_source(octree), owners = std::move(owners)](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) { visit(owners.owned(leaf)); });
  };
}

}  // namespace hypermap
