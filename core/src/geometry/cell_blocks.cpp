// SPDX-License-Identifier: BSD-3-Clause
#include "cell_blocks.hpp"

#include <bit>
#include <limits>

namespace hypermap {
namespace {

constexpr std::uint32_t kFreeSlot = std::numeric_limits<std::uint32_t>::max();

std::uint64_t hash_of(const PointCell& block) {
  const auto part = [](std::int32_t v, std::uint64_t factor) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) * factor;
  };
  const std::uint64_t h = part(block.x, 0x9E3779B97F4A7C15U) ^ part(block.y, 0xC2B2AE3D27D4EB4FU) ^
                          part(block.z, 0x165667B19E3779F9U);
  return h ^ (h >> 32U);
}

}  // namespace

CellBlocks::CellBlocks(std::span<const PointVote> votes)
    : slots_(std::bit_ceil(2 * votes.size() + 1), kFreeSlot) {
  of_cells_.reserve(votes.size());
  for (const PointVote& vote : votes) {
    const PointCell block = block_of(vote.cell);
    std::uint32_t& number = slots_[slot_of(block)];
    if (number == kFreeSlot) {
      number = static_cast<std::uint32_t>(blocks_.size());
      blocks_.push_back(block);
    }
    of_cells_.push_back(number);
  }
}

std::size_t CellBlocks::slot_of(const PointCell& block) const noexcept {
  std::uint64_t slot = hash_of(block) & (slots_.size() - 1);
  while (slots_[slot] != kFreeSlot && blocks_[slots_[slot]] != block) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

std::optional<std::uint32_t> CellBlocks::find(const PointCell& block) const noexcept {
  const std::uint32_t number = slots_[slot_of(block)];
  return number == kFreeSlot ? std::nullopt : std::optional(number);
}

}  // namespace hypermap
