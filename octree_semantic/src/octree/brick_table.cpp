// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick_table.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// Fibonacci hashing: neighbours in Morton order are spread over the table.
std::size_t slot_of(BrickKey key, std::size_t num_slots) noexcept {
  const std::uint64_t mixed = key.code * 0x9E37'79B9'7F4A'7C15ULL;
  return static_cast<std::size_t>(mixed >> 20U) & (num_slots - 1);
}

}  // namespace

std::uint32_t BrickTable::position(BrickKey key) const noexcept {
  if (num_bricks_ == 0) return kNone;
  const std::size_t num = num_slots();
  for (std::size_t slot = slot_of(key, num);; slot = (slot + 1) & (num - 1)) {
    const std::uint32_t candidate = slots_[slot / kSlotsPerPage].positions[slot % kSlotsPerPage];
    if (candidate == kNone || this->key(candidate) == key) return candidate;
  }
}

std::size_t BrickTable::empty_slot(BrickKey key) const noexcept {
  const std::size_t num = num_slots();
  std::size_t slot = slot_of(key, num);
  while (slots_[slot / kSlotsPerPage].positions[slot % kSlotsPerPage] != kNone) {
    slot = (slot + 1) & (num - 1);
  }
  return slot;
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
  if (!is_fully_free(found)) unshare(found);
  return found;
}

std::uint32_t BrickTable::make(BrickKey key) {
  if (!pool_) pool_ = std::make_shared<BrickPool>();
  if (shares_free_space_ && !fully_free_) make_fully_free();
  if (num_slots() < 2 * (num_bricks_ + 1)) grow_slots();
  const std::size_t page_index = num_bricks_ / kPageSize;
  if (page_index == pages_.size()) {
    newest_.resize(page_index / PageTree<BrickPage>::kFanOut + 1);
    pages_.append(CowRef<BrickPage>::make());
  }
  const std::size_t slot = empty_slot(key);
  BrickRef brick = pool_->make_blank();
  SlotPage& slots = slots_.unshared(slot / kSlotsPerPage);
  BrickPage& page = pages_.unshared(page_index);
  // From here on nothing can fail.
  const auto made = static_cast<std::uint32_t>(num_bricks_);
  page.keys[made % kPageSize] = key;
  page.bricks[made % kPageSize] = std::move(brick);
  slots.positions[slot % kSlotsPerPage] = made;
  ++num_bricks_;
  return made;
}

void BrickTable::make_fully_free() {
  BrickRef made = pool_->make_blank();
  Brick& brick = made.sole();
  brick.known.words.fill(~std::uint64_t{0});
  brick.log_odds.fill(fully_free_log_odds_);
  fully_free_ = std::move(made);
}

void BrickTable::unshare(std::uint32_t position) {
  BrickRef& brick = pages_.unshared(position / kPageSize).bricks[position % kPageSize];
  if (brick.is_sole()) return;
  brick = pool_->make_copy(*brick);
  ++num_copied_;
}

void BrickTable::share_if_fully_free(std::uint32_t position) noexcept {
  if (!fully_free_ || is_fully_free(position) || !same_unlabelled(brick(position), *fully_free_))
    return;
  sole_ref(position) = fully_free_;
}

void BrickTable::note_written(std::uint32_t position, bool changed) noexcept {
  const std::size_t page_index = position / kPageSize;
  BrickPage& page = pages_.sole(page_index);
  Moments& of_directory = newest_[page_index / PageTree<BrickPage>::kFanOut];
  for (Moments* moments : {&page.moments[position % kPageSize], &page.newest, &of_directory}) {
    moments->written = revision_ + 1;
    if (changed) moments->changed = revision_ + 1;
  }
}

/// The pool keeps what one revision copies while a copy of the table is alive, and forgets it
/// slowly when there is none.
void BrickTable::commit() noexcept {
  ++revision_;
  if (!pool_) return;
  const std::size_t capacity = pool_->capacity();
  pool_->set_capacity(std::max({BrickPool::kMinCapacity, num_copied_, capacity - capacity / 16}));
  num_copied_ = 0;
}

void BrickTable::grow_slots() {
  const std::size_t num_pages = std::max<std::size_t>(1, 2 * slots_.size());
  Slots grown;
  for (std::size_t i = 0; i < num_pages; ++i) {
    auto page = CowRef<SlotPage>::make();
    page.sole().positions.fill(kNone);
    grown.append(std::move(page));
  }
  const std::size_t num = num_pages * kSlotsPerPage;
  for (std::uint32_t i = 0; i < num_bricks_; ++i) {
    std::size_t slot = slot_of(key(i), num);
    while (grown[slot / kSlotsPerPage].positions[slot % kSlotsPerPage] != kNone) {
      slot = (slot + 1) & (num - 1);
    }
    grown.sole(slot / kSlotsPerPage).positions[slot % kSlotsPerPage] = i;
  }
  slots_ = std::move(grown);
}

std::vector<std::uint32_t> BrickTable::in_morton_order() const {
  std::vector<std::pair<BrickKey, std::uint32_t>> sorted(num_bricks_);
  for (std::uint32_t i = 0; i < num_bricks_; ++i) sorted[i] = {key(i), i};
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> order(num_bricks_);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = sorted[i].second;
  return order;
}

std::vector<std::uint32_t> BrickTable::changed_since(Revision since_revision) const {
  return since(since_revision, &Moments::changed);
}

std::vector<std::uint32_t> BrickTable::written_since(Revision since_revision) const {
  return since(since_revision, &Moments::written);
}

std::vector<std::uint32_t> BrickTable::since(Revision moment, Revision Moments::*kind) const {
  constexpr std::size_t kFanOut = PageTree<BrickPage>::kFanOut;
  std::vector<std::uint32_t> positions;
  for (std::size_t directory = 0; directory < newest_.size(); ++directory) {
    if (newest_[directory].*kind <= moment) continue;
    const std::size_t end = std::min(pages_.size(), (directory + 1) * kFanOut);
    for (std::size_t i = directory * kFanOut; i < end; ++i) {
      const BrickPage& page = pages_[i];
      if (page.newest.*kind <= moment) continue;
      for (std::size_t k = 0; k < kPageSize; ++k) {
        if (page.moments[k].*kind <= moment) continue;
        positions.push_back(static_cast<std::uint32_t>(i * kPageSize + k));
      }
    }
  }
  return positions;
}

std::size_t BrickTable::memory_bytes() const {
  std::size_t total = sizeof(*this) + pages_.memory_bytes() + slots_.memory_bytes() +
                      newest_.capacity() * sizeof(Moments);
  for (std::uint32_t i = 0; i < num_bricks_; ++i) {
    if (!is_fully_free(i)) total += brick(i).memory_bytes();
  }
  if (fully_free_) total += fully_free_->memory_bytes();
  if (pool_) total += pool_->num_idle() * sizeof(Brick);
  return total;
}

}  // namespace hypermap
