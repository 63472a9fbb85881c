// SPDX-License-Identifier: BSD-3-Clause
// What other threads see of a map while it grows.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "mapper/snapshot_exchange.hpp"

#include <cstdint>
#include <memory>
#include <new>

namespace hypermap {

void SemanticMapper::publish() {
  snapshots_->publish(std::make_shared<const MapSnapshot>(MapSnapshot{
      octree_, objects_, topological_map_, classes_, num_frames_, frame_index_, stamp_}));
  num_published_frames_ = num_frames_;
}

/// Whatever fails here leaves the snapshot before.
bool SemanticMapper::publish_if_due() {
  const auto every = static_cast<std::uint64_t>(options_.publish_every_n_frames);
  if (every == 0 || num_frames_ - num_published_frames_ < every) return false;
  if (!pending_relabels_.empty()) return false;  // some voxels still name an object that is gone
  try {
    publish();
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

std::shared_ptr<const MapSnapshot> SemanticMapper::snapshot() const {
  return snapshots_->newest();
}

}  // namespace hypermap
