// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick_pool.hpp"

#include <memory>

namespace hypermap {
namespace {

void free_chain(Brick* first) noexcept {
  while (first != nullptr) {
    const std::unique_ptr<Brick> brick(first);
    first = brick->next_idle;
  }
}

}  // namespace

BrickPool::~BrickPool() {
  free_chain(returned_.load(std::memory_order_acquire));
  free_chain(taken_);
}

BrickRef BrickPool::make_blank() {
  BrickRef made = take_or_make();
  Brick& brick = made.sole();
  brick.known = {};
  brick.occupied = {};
  brick.log_odds.fill(0);
  return made;
}

BrickRef BrickPool::make_copy(const Brick& source) {
  auto labels = source.labels ? std::make_unique<LabelTable>(*source.labels) : nullptr;
  BrickRef made = take_or_make();
  Brick& brick = made.sole();
  brick.known = source.known;
  brick.occupied = source.occupied;
  brick.log_odds = source.log_odds;
  brick.labels = std::move(labels);
  return made;
}

BrickRef BrickPool::take_or_make() {
  std::unique_ptr<Brick> brick(take());
  if (!brick) brick = std::make_unique<Brick>();
  brick->home = this;
  return BrickRef(std::move(brick));
}

Brick* BrickPool::take() noexcept {
  if (num_idle() == 0 || taking_.test_and_set(std::memory_order_acquire)) return nullptr;
  if (taken_ == nullptr) taken_ = returned_.exchange(nullptr, std::memory_order_acquire);
  Brick* brick = taken_;
  if (brick != nullptr) {
    taken_ = brick->next_idle;
    num_idle_.fetch_sub(1, std::memory_order_relaxed);
  }
  taking_.clear(std::memory_order_release);
  return brick;
}

void BrickPool::give_back(Brick* brick) noexcept {
  std::unique_ptr<Brick> returned(brick);
  if (num_idle_.fetch_add(1, std::memory_order_relaxed) >= capacity()) {
    num_idle_.fetch_sub(1, std::memory_order_relaxed);
    return;
  }
  brick->labels.reset();
  brick->next_idle = returned_.load(std::memory_order_relaxed);
  while (!returned_.compare_exchange_weak(
      brick->next_idle, brick, std::memory_order_release, std::memory_order_relaxed)) {
  }
  static_cast<void>(returned.release());
}

}  // namespace hypermap
