// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/brick_table.hpp"

#include <algorithm>
#include <numeric>

namespace hypermap {
namespace {

constexpr std::size_t kFirstNumSlots = 64;
/// Bricks kept for later, 76 KiB: what a frame's noise takes back of the free space.
constexpr std::size_t kMaxSpares = 64;

/// Fibonacci hashing: neighbours in Morton order are spread over the table.
std::size_t slot_of(BrickKey key, std::size_t num_slots) noexcept {
  const std::uint64_t mixed = key.code * 0x9E37'79B9'7F4A'7C15ULL;
  return static_cast<std::size_t>(mixed >> 20U) & (num_slots - 1);
}

}  // namespace

std::uint32_t BrickTable::position(BrickKey key) const noexcept {
  if (slots_.empty()) return kNone;
  for (std::size_t slot = slot_of(key, slots_.size());; slot = (slot + 1) & (slots_.size() - 1)) {
    const std::uint32_t candidate = slots_[slot];
    if (candidate == kNone || keys_[candidate] == key) return candidate;
  }
}

std::uint32_t BrickTable::prepare(BrickKey key) {
  const std::uint32_t found = position(key);
  if (found == kNone) return make(key);
  unshare(found);
  return found;
}

std::uint32_t BrickTable::prepare_to_free(BrickKey key) {
  const std::uint32_t found = position(key);
  if (found == kNone) return make(key);
  if (!is_freest(found)) unshare(found);
  return found;
}

std::uint32_t BrickTable::make(BrickKey key) {
  if (shares_free_space_ && !freest_) make_freest();
  if (slots_.size() < 2 * (bricks_.size() + 1)) grow_slots();
  if (keys_.size() == keys_.capacity()) keys_.reserve(2 * keys_.size() + kFirstNumSlots);
  if (bricks_.size() == bricks_.capacity()) bricks_.reserve(2 * bricks_.size() + kFirstNumSlots);
  const auto made = static_cast<std::uint32_t>(bricks_.size());
  bricks_.push_back(BrickRef::make());
  keys_.push_back(key);
  std::size_t slot = slot_of(key, slots_.size());
  while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
  slots_[slot] = made;
  return made;
}

void BrickTable::make_freest() {
  spares_.reserve(kMaxSpares);
  BrickRef made = BrickRef::make();
  Brick& brick = made.writable();
  brick.known.words.fill(~std::uint64_t{0});
  brick.log_odds.fill(freest_log_odds_);
  freest_ = std::move(made);
}

void BrickTable::unshare(std::uint32_t position) {
  if (is_freest(position) && !spares_.empty()) {
    bricks_[position] = std::move(spares_.back());
    spares_.pop_back();
  }
  static_cast<void>(bricks_[position].writable());
}

void BrickTable::share_if_freest(std::uint32_t position) noexcept {
  BrickRef& brick = bricks_[position];
  if (!freest_ || brick.shares(freest_) || !same_unlabelled(*brick, *freest_)) return;
  if (spares_.size() < spares_.capacity()) spares_.push_back(std::move(brick));
  brick = freest_;
}

void BrickTable::grow_slots() {
  std::vector<std::uint32_t> grown(std::max(kFirstNumSlots, 2 * slots_.size()), kNone);
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    std::size_t slot = slot_of(keys_[i], grown.size());
    while (grown[slot] != kNone) slot = (slot + 1) & (grown.size() - 1);
    grown[slot] = i;
  }
  slots_ = std::move(grown);
}

std::vector<std::uint32_t> BrickTable::in_morton_order() const {
  std::vector<std::uint32_t> order(bricks_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
    return keys_[a] < keys_[b];
  });
  return order;
}

void BrickTable::reserve_changes(std::size_t num_changes) {
  if (changes_.size() > bricks_.size() + kFirstNumSlots) {
    const std::size_t dropped = changes_.size() / 2;
    forgotten_ = changes_[dropped - 1].revision;
    changes_.erase(changes_.begin(), changes_.begin() + static_cast<std::ptrdiff_t>(dropped));
  }
  const std::size_t needed = changes_.size() + num_changes;
  if (needed > changes_.capacity()) changes_.reserve(std::max(needed, 2 * changes_.capacity()));
}

std::vector<std::uint32_t> BrickTable::changed_since(Revision since) const {
  std::vector<std::uint32_t> changed;
  if (since < forgotten_) {
    changed.resize(bricks_.size());
    std::iota(changed.begin(), changed.end(), 0U);
    return changed;
  }
  const auto first = std::upper_bound(
      changes_.begin(), changes_.end(), since, [](Revision revision, const Change& change) {
        return revision < change.revision;
      });
  for (auto change = first; change != changes_.end(); ++change) {
    changed.push_back(change->position);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

std::size_t BrickTable::memory_bytes() const {
  std::size_t total = slots_.capacity() * sizeof(std::uint32_t) +
                      keys_.capacity() * sizeof(BrickKey) + bricks_.capacity() * sizeof(BrickRef) +
                      changes_.capacity() * sizeof(Change) + spares_.capacity() * sizeof(BrickRef);
  for (const BrickRef& brick : bricks_) {
    if (!freest_ || !brick.shares(freest_)) total += brick->memory_bytes();
  }
  if (freest_) total += freest_->memory_bytes();
  for (const BrickRef& spare : spares_) total += spare->memory_bytes();
  return total;
}

}  // namespace hypermap
