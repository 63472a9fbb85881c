// SPDX-License-Identifier: BSD-3-Clause
#include "block_votes.hpp"

#include "point_votes.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

PointCell block_of(const PointCell& cell) {
  return {cell.x >> kBlockShift, cell.y >> kBlockShift, cell.z >> kBlockShift};
}

std::uint64_t hash_of(const PointCell& block) {
  const auto part = [](std::int32_t v, std::uint64_t factor) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) * factor;
  };
  const std::uint64_t h = part(block.x, 0x9E3779B97F4A7C15U) ^ part(block.y, 0xC2B2AE3D27D4EB4FU) ^
                          part(block.z, 0x165667B19E3779F9U);
  return h ^ (h >> 32U);
}

/// Numbers blocks from 0 in the order in which they appear; open addressing, at most half full.
class BlockNumbers {
 public:
  explicit BlockNumbers(std::size_t max_blocks)
      : slots_(std::bit_ceil(2 * max_blocks + 1), kFree) {}

  /// The position in `blocks()` of this one, which is appended when it is new.
  std::uint32_t number_of(const PointCell& block) {
    for (std::uint64_t slot = hash_of(block);; ++slot) {
      std::uint32_t& number = slots_[slot & (slots_.size() - 1)];
      if (number == kFree) {
        number = static_cast<std::uint32_t>(blocks_.size());
        blocks_.push_back({block, 0});
        return number;
      }
      if (blocks_[number].cell == block) return number;
    }
  }
  [[nodiscard]] std::vector<PointVote>& blocks() { return blocks_; }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slots_;
  std::vector<PointVote> blocks_;
};

std::uint32_t saturated_sum(std::uint32_t a, std::uint32_t b) {
  return a > std::numeric_limits<std::uint32_t>::max() - b
             ? std::numeric_limits<std::uint32_t>::max()
             : a + b;
}

}  // namespace

BlockVotes block_votes(std::span<const PointVote> votes) {
  BlockNumbers numbers(votes.size());
  BlockVotes out;
  out.of_cell.reserve(votes.size());
  out.best_of_cell.reserve(votes.size());
  std::vector<std::uint32_t> best;
  for (const PointVote& vote : votes) {
    const std::uint32_t number = numbers.number_of(block_of(vote.cell));
    std::uint32_t& sum = numbers.blocks()[number].votes;
    sum = saturated_sum(sum, vote.votes);
    out.of_cell.push_back(number);
    if (number == best.size()) best.push_back(0);
    best[number] = std::max(best[number], vote.votes);
  }
  for (std::uint32_t& number : out.of_cell) {
    out.best_of_cell.push_back(best[number]);
    number = numbers.blocks()[number].votes;
  }
  out.typical = typical_votes(numbers.blocks());
  return out;
}

}  // namespace hypermap
