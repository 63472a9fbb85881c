// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds bricks by key, and tells which of them changed since a given moment.
#pragma once

#include "hypermap/octree_semantic/octree/brick.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Moments of a table: each commit of changes is one more. 0: before anything was written.
using Revision = std::uint64_t;

/// All bricks of a map. A copy shares the bricks until either side writes.
///
/// Bricks have a position 0, 1, 2, ... in the order in which they came to be, which stays the same
/// for the life of the table. A brick may be blank (no voxel known); it counts as absent.
///
/// Empty space makes up most of a map, and all its bricks are alike once each of their voxels is as
/// free as it can be: those share one brick.
class BrickTable {
 public:
  BrickTable() = default;  ///< Shares no free space.
  /// `freest`: the log-odds at which a voxel cannot become any freer.
  explicit BrickTable(MilliLogOdds freest) : freest_log_odds_(freest), shares_free_space_(true) {}

  /// "No such brick".
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  [[nodiscard]] std::size_t size() const noexcept { return bricks_.size(); }
  [[nodiscard]] std::uint32_t position(BrickKey key) const noexcept;
  [[nodiscard]] const Brick* find(BrickKey key) const noexcept {
    const std::uint32_t found = position(key);
    return found == kNone ? nullptr : &*bricks_[found];
  }
  /// Requires: position < size().
  [[nodiscard]] BrickKey key(std::uint32_t position) const noexcept { return keys_[position]; }
  [[nodiscard]] const Brick& brick(std::uint32_t position) const noexcept {
    return *bricks_[position];
  }

  /// The position of the brick with this key, made when absent and unshared when shared, so that
  /// `writable` below cannot fail. Throws std::bad_alloc, and the content is unchanged then.
  std::uint32_t prepare(BrickKey key);
  /// As `prepare`, for one who would only make voxels freer: where nothing is left to do
  /// (`is_freest`) the brick stays shared and is not to be written.
  std::uint32_t prepare_to_free(BrickKey key);
  /// Whether all of a brick's voxels are known to be as free as they can be, and it is the shared
  /// one.
  [[nodiscard]] bool is_freest(std::uint32_t position) const noexcept {
    return freest_ && bricks_[position].shares(freest_);
  }
  /// Shares a brick that has become as free as it can be. Its memory serves the next brick that
  /// ceases to be.
  void share_if_freest(std::uint32_t position) noexcept;
  /// Requires: `prepare` returned this position and the table was not copied since.
  [[nodiscard]] Brick& writable(std::uint32_t position) { return bricks_[position].writable(); }

  /// Positions in the order of their keys' Morton codes.
  [[nodiscard]] std::vector<std::uint32_t> in_morton_order() const;

  [[nodiscard]] Revision revision() const noexcept { return revision_; }
  /// Makes room so that noting `num_changes` changes cannot throw.
  void reserve_changes(std::size_t num_changes);
  /// Notes that a brick's occupied voxels or labels changed in the coming revision.
  void note_change(std::uint32_t position) { changes_.push_back({revision_ + 1, position}); }
  void commit() noexcept { ++revision_; }
  /// Positions that changed after `since`, each once, ascending. Cost: linear in the changes since
  /// then; when that is too long ago, all bricks.
  [[nodiscard]] std::vector<std::uint32_t> changed_since(Revision since) const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Change {
    Revision revision = 0;
    std::uint32_t position = 0;
  };
  void grow_slots();
  std::uint32_t make(BrickKey key);
  void unshare(std::uint32_t position);
  void make_freest();

  std::vector<std::uint32_t> slots_;  // open addressing; positions, kNone where empty
  std::vector<BrickKey> keys_;
  std::vector<BrickRef> bricks_;
  std::vector<Change> changes_;  // ascending revisions, all after forgotten_
  Revision revision_ = 0;
  Revision forgotten_ = 0;
  MilliLogOdds freest_log_odds_ = 0;
  bool shares_free_space_ = false;
  BrickRef freest_;               ///< Null until there is a brick.
  std::vector<BrickRef> spares_;  ///< Of the content of `freest_`, not in use.
};

}  // namespace hypermap
