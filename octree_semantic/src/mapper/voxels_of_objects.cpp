// SPDX-License-Identifier: BSD-3-Clause
// An id never outlives its object: where the voxels lie that bear it, and what becomes of them when
// objects are merged or removed.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <limits>
#include <utility>

namespace hypermap {
namespace {

Box no_voxel() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::Vector3d::Constant(infinity), Eigen::Vector3d::Constant(-infinity)};
}

}  // namespace

void SemanticMapper::find_voxels_of_objects() {
  octree_.forget_objects([this](ObjectId id) { return !objects_.contains(id); });
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * octree_.resolution_m());
  octree_.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (!leaf.label || leaf.label->object == kNoObject) return;
    const Eigen::Vector3d centre = octree_.grid().centre(leaf.key).xyz;
    Box& bounds = voxel_bounds_.try_emplace(leaf.label->object, no_voxel()).first->second;
    bounds = bounding_box(bounds, {centre - half, centre + half});
  });
}

void SemanticMapper::prepare_to_adopt(std::span<const PixelLabels> labels,
                                      std::span<const ObjectMerge> merges) {
  for (const PixelLabels& label : labels) {
    if (label.object != kNoObject) voxel_bounds_.try_emplace(label.object, no_voxel());
  }
  for (const ObjectMerge& merge : merges) voxel_bounds_.try_emplace(merge.into, no_voxel());
  pending_relabels_.reserve(merges.size());
}

void SemanticMapper::adopt(ObjectMap objects,
                           std::span<const PixelLabels> labels,
                           std::span<const ObjectMerge> merges) noexcept {
  objects_ = std::move(objects);
  for (const auto& [from, into] : merges) {
    Box bounds = take_voxel_bounds(from);
    grow_voxel_bounds(into, bounds);
    pending_relabels_.push_back({from, into, bounds});
  }
  const auto boxes = integrator_.label_boxes();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (boxes[i]) grow_voxel_bounds(labels[i].object, *boxes[i]);
  }
}

void SemanticMapper::grow_voxel_bounds(ObjectId id, const Box& by) noexcept {
  const auto found = voxel_bounds_.find(id);
  if (found != voxel_bounds_.end()) found->second = bounding_box(found->second, by);
}

Box SemanticMapper::take_voxel_bounds(ObjectId id) noexcept {
  const auto found = voxel_bounds_.find(id);
  if (found == voxel_bounds_.end()) return no_voxel();
  Box bounds = found->second;
  voxel_bounds_.erase(found);
  return bounds;
}

/// In their order, for one may take what another gave. One that fails is tried again: it starts
/// with what is left of its voxels.
void SemanticMapper::apply_pending_relabels() {
  while (!pending_relabels_.empty()) {
    const PendingRelabel& first = pending_relabels_.front();
    octree_.relabel_object(first.from, first.into, first.bounds);
    pending_relabels_.erase(pending_relabels_.begin());
  }
}

}  // namespace hypermap
