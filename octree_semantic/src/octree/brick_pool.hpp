// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Memory of bricks that nobody owns any more, for the next ones.
#pragma once

#include "octree/brick.hpp"

#include <atomic>
#include <cstddef>

namespace hypermap {

/// Keeps a bounded number of idle bricks. It outlives every brick that came from it: whoever owns
/// such a brick owns the pool, and gives it up last.
///
/// Threads: all of it from any thread; nobody ever waits for another.
class BrickPool {
 public:
  /// Idle bricks that are always kept, 76 KiB: what a frame's noise takes back of the free space.
  static constexpr std::size_t kMinCapacity = 64;

  BrickPool() = default;
  BrickPool(const BrickPool&) = delete;
  BrickPool& operator=(const BrickPool&) = delete;
  BrickPool(BrickPool&&) = delete;
  BrickPool& operator=(BrickPool&&) = delete;
  ~BrickPool();

  /// A brick without any known voxel.
  [[nodiscard]] BrickRef make_blank();
  /// A brick of the same content.
  [[nodiscard]] BrickRef make_copy(const Brick& source);

  /// Keeps the brick for later, or frees it when enough are kept.
  void give_back(Brick* brick) noexcept;
  /// At most so many idle bricks are kept from now on; kMinCapacity to begin with.
  void set_capacity(std::size_t num_bricks) noexcept {
    capacity_.store(num_bricks, std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t capacity() const noexcept {
    return capacity_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t num_idle() const noexcept {
    return num_idle_.load(std::memory_order_relaxed);
  }

 private:
  [[nodiscard]] Brick* take() noexcept;
  [[nodiscard]] BrickRef take_or_make();

  /// Returned bricks, linked by `next_idle`. Pushed one by one and taken all at once, so that no
  /// brick can come back between a look at it and its removal.
  std::atomic<Brick*> returned_{nullptr};
  std::atomic<std::size_t> num_idle_{0};
  std::atomic<std::size_t> capacity_{kMinCapacity};
  /// Who sets it may pop from `taken_`; who finds it set allocates instead of waiting.
  std::atomic_flag taking_;
  Brick* taken_ = nullptr;
};

}  // namespace hypermap
