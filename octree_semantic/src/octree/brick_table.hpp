// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds bricks by key, and lists those that changed since a given revision.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/octree_semantic/octree/revision.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"
#include "octree/brick.hpp"
#include "octree/brick_pool.hpp"
#include "octree/page_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace hypermap {

/// All bricks of a map. A copy shares pages and bricks until either side writes: it costs one
/// reference for each 1,024 bricks, and a write after it the pages that it touches.
///
/// Bricks have a position 0, 1, 2, ... in the order in which they came to be, which stays the same
/// for the life of the table. A brick may be blank (no voxel known); it counts as absent.
///
/// Empty space makes up most of a map, and all its bricks are alike once each of their voxels is
/// fully free: those share one brick.
class BrickTable {
 public:
  BrickTable() = default;  ///< Shares no free space.
  /// `fully_free`: the log-odds of fully free voxels, the lower clamp.
  explicit BrickTable(MilliLogOdds fully_free)
      : fully_free_log_odds_(fully_free), shares_free_space_(true) {}
  BrickTable(const BrickTable&) = default;
  BrickTable& operator=(const BrickTable&) = delete;
  BrickTable(BrickTable&&) = delete;
  BrickTable& operator=(BrickTable&&) = delete;
  ~BrickTable() = default;

  /// "No such brick".
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  [[nodiscard]] std::size_t size() const noexcept { return num_bricks_; }
  [[nodiscard]] std::uint32_t position(BrickKey key) const noexcept;
  [[nodiscard]] const Brick* find(BrickKey key) const noexcept {
    const std::uint32_t found = position(key);
    return found == kNone ? nullptr : &brick(found);
  }
  /// Requires: position < size().
  [[nodiscard]] BrickKey key(std::uint32_t position) const noexcept {
    return pages_[position / kPageSize].keys[position % kPageSize];
  }
  [[nodiscard]] const Brick& brick(std::uint32_t position) const noexcept { return *ref(position); }

  /// The position of the brick with this key, made when absent and unshared when shared, so that
  /// `writable` below cannot fail. Throws std::bad_alloc, and the content is unchanged then.
  std::uint32_t prepare(BrickKey key);
  /// As `prepare`, for free updates only: a brick that is fully free (`is_fully_free`) stays shared
  /// and is not to be written.
  std::uint32_t prepare_to_free(BrickKey key);
  /// Whether it is the shared brick whose voxels are all fully free.
  [[nodiscard]] bool is_fully_free(std::uint32_t position) const noexcept {
    return fully_free_ && ref(position).shares(fully_free_);
  }
  /// Requires, here and below: `prepare` returned this position and the table was not copied since.
  [[nodiscard]] Brick& writable(std::uint32_t position) noexcept {
    return sole_ref(position).sole();
  }
  /// Shares a brick that became fully free. Its memory serves the next brick that ceases to be.
  void share_if_fully_free(std::uint32_t position) noexcept;
  /// Notes that a brick was written in the coming revision, and whether its occupied voxels or
  /// labels changed.
  void note_written(std::uint32_t position, bool changed) noexcept;
  void commit() noexcept;

  /// Positions in the order of their keys' Morton codes.
  [[nodiscard]] std::vector<std::uint32_t> in_morton_order() const;

  [[nodiscard]] Revision revision() const noexcept { return revision_; }
  /// Positions of bricks whose occupied voxels or labels changed after `since`, ascending. Cost: a
  /// look at each 1,024 bricks, then at what changed.
  [[nodiscard]] std::vector<std::uint32_t> changed_since(Revision since) const;
  /// Positions of bricks that were written after `since`, changed or not, ascending. Cost: the
  /// same.
  [[nodiscard]] std::vector<std::uint32_t> written_since(Revision since) const;

  [[nodiscard]] std::size_t memory_bytes() const;

  OwnerCount owners;

 private:
  static constexpr std::size_t kPageSize = 16;
  static constexpr std::size_t kSlotsPerPage = 256;

  /// When something last happened to any of several bricks.
  struct Moments {
    Revision changed = 0;
    Revision written = 0;
  };
  struct BrickPage {
    std::array<BrickKey, kPageSize> keys{};
    std::array<BrickRef, kPageSize> bricks;
    std::array<Moments, kPageSize> moments{};
    Moments newest;
    OwnerCount owners;
  };
  /// Open addressing; positions, kNone where empty.
  struct SlotPage {
    std::array<std::uint32_t, kSlotsPerPage> positions{};
    OwnerCount owners;
  };
  using Slots = PageTree<SlotPage>;

  [[nodiscard]] const BrickRef& ref(std::uint32_t position) const noexcept {
    return pages_[position / kPageSize].bricks[position % kPageSize];
  }
  [[nodiscard]] BrickRef& sole_ref(std::uint32_t position) noexcept {
    return pages_.sole(position / kPageSize).bricks[position % kPageSize];
  }
  [[nodiscard]] std::size_t num_slots() const noexcept { return slots_.size() * kSlotsPerPage; }
  [[nodiscard]] std::size_t empty_slot(BrickKey key) const noexcept;
  [[nodiscard]] std::vector<std::uint32_t> since(Revision moment, Revision Moments::*kind) const;
  void grow_slots();
  std::uint32_t make(BrickKey key);
  void unshare(std::uint32_t position);
  void make_fully_free();

  std::shared_ptr<BrickPool> pool_;  // first: it outlives the bricks; null until there is one
  PageTree<BrickPage> pages_;
  Slots slots_;
  std::vector<Moments> newest_;  // of each directory of pages
  std::size_t num_bricks_ = 0;
  std::size_t num_copied_ = 0;  // bricks, for the coming revision
  Revision revision_ = 0;
  MilliLogOdds fully_free_log_odds_ = 0;
  bool shares_free_space_ = false;
  BrickRef fully_free_;  ///< Null until there is a brick.
};

}  // namespace hypermap
