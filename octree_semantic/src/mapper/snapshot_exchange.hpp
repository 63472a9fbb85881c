// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where one thread leaves its newest snapshot for all others.
#pragma once

#include "hypermap/octree_semantic/mapper/map_snapshot.hpp"

#include <memory>
#include <mutex>
#include <utility>

namespace hypermap {

/// Holds the newest snapshot.
///
/// Threads: all of it from any thread. The lock is held while one pointer is copied or swapped and
/// no longer: neither side ever waits for the work of the other, and old snapshots are freed
/// outside of it. (std::atomic<std::shared_ptr> does the same with a spinning lock in libstdc++ 12,
/// and in a way that the thread sanitizer cannot follow.)
class SnapshotExchange {
 public:
  /// Requires: not null.
  explicit SnapshotExchange(std::shared_ptr<const MapSnapshot> first) : newest_(std::move(first)) {}

  [[nodiscard]] std::shared_ptr<const MapSnapshot> newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
  }
  void publish(std::shared_ptr<const MapSnapshot> snapshot) {
    {
      const std::lock_guard lock(mutex_);
      newest_.swap(snapshot);
    }
    snapshot.reset();  // frees the one before when nobody holds it, outside of the lock
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const MapSnapshot> newest_;
};

}  // namespace hypermap
