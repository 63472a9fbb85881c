// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object.hpp"
#include "octree/point_mask.hpp"

#include <unordered_map>
#include <utility>

namespace hypermap {
namespace {

/// A surface is measured so much before or behind where it is.
constexpr double kSurfaceNoiseM = 0.05;
/// Points are sparse within a surface: a cube covers those so near to it.
constexpr double kPointGapM = 0.01;
constexpr double kMaskEdgeM = 0.01;

struct Owner {
  OwnerLabel label;
  Box bounds;  ///< Of the object, grown by the noise.
  PointMask points;
  Polygon hull;  ///< Of the object's points from above; empty when it has none.
};

Box cube_at(const Eigen::Vector3d& centre, double edge_m) {
  return grown({centre, centre}, 0.5 * edge_m);
}

bool reaches(const Owner& owner, const Box& cube) {
  if (!owner.bounds.intersects(cube)) return false;
  return owner.points.empty() || owner.points.count(grown(cube, kSurfaceNoiseM)) > 0;
}

/// Among points of the owner, and not of what it stands on, though none lies in the cube.
bool encloses(const Owner& owner, const Box& cube) {
  const Eigen::Vector3d middle = cube.centre();
  const double foot_m = owner.bounds.min_in_map.z() + kSurfaceNoiseM;
  return middle.z() > foot_m + cube.extent().z() && !owner.hull.outer.empty() &&
         contains(owner.hull, middle.head<2>()) && reaches(owner, cube);
}

}  // namespace

struct VoxelOwners::Index {
  ObjectMap objects;
  std::unordered_map<ObjectId, Owner> owners;

  /// The owner that the voxel is labelled with, when it reaches it.
  [[nodiscard]] const Owner* labelled(ObjectId object, const Box& cube) const {
    const auto found = owners.find(object);
    return found != owners.end() && reaches(found->second, cube) ? &found->second : nullptr;
  }

  /// The owner with most points in the cube or next to it, else the one that encloses it.
  [[nodiscard]] std::optional<Owned> covering(const Box& cube) const {
    std::optional<Owned> best;
    std::size_t most = 0;
    for (const ObjectId id : objects.query(grown(cube, kSurfaceNoiseM))) {  // ascending
      const auto found = owners.find(id);
      if (found == owners.end()) continue;
      const std::size_t count = found->second.points.count(grown(cube, kPointGapM));
      if (count <= most) continue;
      most = count;
      best = Owned{id, found->second.label};
    }
    return best ? best : enclosing(cube);
  }

  /// The only owner that reaches the cube and encloses its middle, above its foot.
  [[nodiscard]] std::optional<Owned> enclosing(const Box& cube) const {
    const Eigen::Vector3d middle = cube.centre();
    std::optional<Owned> only;
    for (const ObjectId id : objects.query(Box{middle, middle})) {
      const auto found = owners.find(id);
      if (found == owners.end() || !encloses(found->second, cube)) continue;
      if (only) return std::nullopt;
      only = Owned{id, found->second.label};
    }
    return only;
  }
};

VoxelOwners::VoxelOwners(const ObjectMap& objects, std::span<const ObjectId> confirmed) {
  auto index = std::make_shared<Index>(Index{.objects = objects, .owners = {}});
  index->owners.reserve(confirmed.size());
  for (const ObjectId id : confirmed) {
    const Object* object = objects.find(id);
    const auto best = object != nullptr ? best_class(*object) : std::nullopt;
    if (!best) continue;
    index->owners.emplace(id,
                          Owner{{best->id, LogOdds::of(object_confidence(*object))},
                                grown(object->box, kSurfaceNoiseM),
                                PointMask(object->points.supported_points(), kMaskEdgeM),
                                footprint(*object).value_or(Polygon{})});
  }
  index_ = std::move(index);
}

std::optional<VoxelOwners::Owned> VoxelOwners::find(ObjectId object,
                                                    const Eigen::Vector3d& centre_in_map,
                                                    double edge_m) const {
  const Box cube = cube_at(centre_in_map, edge_m);
  if (const Owner* owner = index_->labelled(object, cube)) return Owned{object, owner->label};
  return index_->covering(cube);
}

LeafSample VoxelOwners::owned(const LeafSample& leaf) const {
  const auto owner =
      leaf.occupied ? find(leaf.object, leaf.centre_in_map, leaf.edge_m) : std::nullopt;
  LeafSample shown = leaf;
  shown.object = owner ? owner->object : kNoObject;
  shown.best_class = owner ? std::optional(owner->label.class_id) : std::nullopt;
  shown.class_log_odds = owner ? owner->label.probability : LogOdds();
  return shown;
}

LeafSource owned_leaves(const SemanticOctree& octree, VoxelOwners owners) {
  return [leaves = leaf_source(octree), owners = std::move(owners)](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) { visit(owners.owned(leaf)); });
  };
}

}  // namespace hypermap
