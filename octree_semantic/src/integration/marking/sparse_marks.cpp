// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_marks.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kFirstCapacity = 1024;
constexpr std::size_t kNumLayers = 3;
constexpr std::size_t kBytesPerBrickOfLayer = kBrickVolume / 8 + 1;
constexpr std::size_t kSlotsPerBrick = 2;

/// Fibonacci hashing, as in BrickTable.
std::size_t sparse_slot_of(BrickKey key, std::size_t num_slots) noexcept {
  return static_cast<std::size_t>((key.code * 0x9E37'79B9'7F4A'7C15ULL) >> 20U) & (num_slots - 1);
}

}  // namespace

void SparseMarks::start(std::size_t max_bricks) {
  clear();
  max_bricks_ = std::min(max_bricks, kMaxBricks);
}

void SparseMarks::clear() noexcept {
  hit.clear();
  passed.clear();
  ends.clear();
  for (const BrickKey key : keys_) {
    // Whoever stands in the key's run of slots goes as well.
    for (std::size_t slot = sparse_slot_of(key, slots_.size()); slots_[slot] != kNone;
         slot = (slot + 1) & (slots_.size() - 1)) {
      slots_[slot] = kNone;
    }
  }
  keys_.clear();
}

std::uint32_t SparseMarks::touch(BrickKey key) {
  const bool is_full = slots_.size() < kSlotsPerBrick * (keys_.size() + 1);
  if (is_full && keys_.size() < max_bricks_) grow();
  std::size_t slot = sparse_slot_of(key, slots_.size());
  for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
    if (keys_[slots_[slot]] == key) return slots_[slot];
  }
  if (keys_.size() >= max_bricks_) return kNone;
  const auto made = static_cast<std::uint32_t>(keys_.size());
  keys_.push_back(key);
  slots_[slot] = made;
  return made;
}

void SparseMarks::grow() {
  const std::size_t capacity = std::max(kFirstCapacity, 2 * (slots_.size() / kSlotsPerBrick));
  std::vector<std::uint32_t> grown(capacity * kSlotsPerBrick, kNone);
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    std::size_t slot = sparse_slot_of(keys_[i], grown.size());
    while (grown[slot] != kNone) slot = (slot + 1) & (grown.size() - 1);
    grown[slot] = i;
  }
  keys_.reserve(capacity);
  for (BitLayer* layer : {&hit, &passed, &ends}) layer->fit(capacity);
  slots_ = std::move(grown);
}

std::size_t SparseMarks::bytes_for(std::size_t num_bricks) noexcept {
  const std::size_t capacity = std::max(kFirstCapacity, std::bit_ceil(num_bricks));
  const std::size_t tables = capacity * (sizeof(BrickKey) + kSlotsPerBrick * sizeof(std::uint32_t));
  // While a layer grows, its old half is still there.
  const std::size_t growing = capacity / 2 * kBytesPerBrickOfLayer;
  return tables + kNumLayers * capacity * kBytesPerBrickOfLayer + growing;
}

}  // namespace hypermap
