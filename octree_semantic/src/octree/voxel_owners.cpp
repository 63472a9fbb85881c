// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include "hypermap/core/objects/object.hpp"
#include "octree/object_surface.hpp"

#include <limits>
#include <unordered_map>
#include <utility>

namespace hypermap {
namespace {

/// A voxel shows what lies within half its edge of its middle and so much farther, by the noise of
/// depth and the gaps between points.
constexpr double kReachM = 0.0325;
/// A segment said so of the voxel itself: its object counts as so much nearer.
constexpr double kLabelledM = 0.0025;

struct Owner {
  OwnerLabel label;
  Box box;  ///< Of the object.
  ObjectSurface surface;
};

double distance_m(const Box& box, const Eigen::Vector3d& place) {
  return (place - place.cwiseMax(box.min_in_map).cwiseMin(box.max_in_map)).norm();
}

/// From a voxel's middle to what it would show of the owner; infinity where that is `most_m` and
/// more, or nothing.
double distance_m(const Owner& owner,
                  const Eigen::Vector3d& middle,
                  bool is_labelled,
                  double most_m) {
  const double nearer_m = is_labelled ? kLabelledM : 0.0;
  if (!owner.surface.empty()) return owner.surface.distance_m(middle, most_m + nearer_m) - nearer_m;
  return is_labelled ? distance_m(owner.box, middle) - nearer_m
                     : std::numeric_limits<double>::infinity();
}

}  // namespace

struct VoxelOwners::Index {
  ObjectMap objects;
  std::unordered_map<ObjectId, Owner> owners;
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
                                object->box,
                                ObjectSurface(object->points)});
  }
  index_ = std::move(index);
}

std::optional<VoxelOwners::Owned> VoxelOwners::find(ObjectId object,
                                                    const Eigen::Vector3d& centre_in_map,
                                                    double edge_m) const {
  std::optional<Owned> nearest;
  double least_m = 0.5 * edge_m + kReachM;
  // Of the mean of two distances the longer one may be twice as long.
  const Box around = grown({centre_in_map, centre_in_map}, 2.0 * (least_m + kLabelledM));
  for (const ObjectId id : index_->objects.query(around)) {  // ascending
    const auto owner = index_->owners.find(id);
    if (owner == index_->owners.end()) continue;
    const double from_it_m = distance_m(owner->second, centre_in_map, id == object, least_m);
    if (!(from_it_m < least_m)) continue;
    least_m = from_it_m;
    nearest = Owned{id, owner->second.label};
  }
  return nearest;
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
