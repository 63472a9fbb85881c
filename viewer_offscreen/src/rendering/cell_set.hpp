// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A set of cells of an unbounded grid, fast for neighbours.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <unordered_map>

namespace hypermap {

/// Cells in blocks of 8 x 8 x 8, one bit each. Requires: coordinates within +-2^22.
class CellSet {
 public:
  void insert(const Eigen::Vector3i& cell) {
    Block& block = blocks_[block_key(cell)];
    block[word(cell)] |= bit(cell);
  }
  [[nodiscard]] bool contains(const Eigen::Vector3i& cell) const {
    const auto found = blocks_.find(block_key(cell));
    return found != blocks_.end() && (found->second[word(cell)] & bit(cell)) != 0;
  }

 private:
  using Block = std::array<std::uint64_t, 8>;

  static std::uint64_t block_key(const Eigen::Vector3i& cell) {
    constexpr int kOffset = 1 << 22;
    const auto part = [](int c) { return static_cast<std::uint64_t>((c + kOffset) >> 3); };
    return part(cell.x()) | (part(cell.y()) << 21U) | (part(cell.z()) << 42U);
  }
  static std::size_t word(const Eigen::Vector3i& cell) {
    return static_cast<std::size_t>(cell.z() & 7);
  }
  static std::uint64_t bit(const Eigen::Vector3i& cell) {
    return std::uint64_t{1} << static_cast<unsigned>((cell.y() & 7) * 8 + (cell.x() & 7));
  }

  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace hypermap
