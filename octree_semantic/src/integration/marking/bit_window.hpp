// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A bit for each voxel around the sensor, laid out in bricks: what one frame says of them.
///
/// The memory is bounded by how far a frame reaches, not by the map; bricks that no measurement
/// touched cost a byte, of which eight are looked at in one go.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace hypermap {

/// Voxels from `min` to `max` per axis, both included. Keys as in VoxelKey, but they may lie
/// outside the volume.
struct KeyBox {
  std::array<int, 3> min{};
  std::array<int, 3> max{};
};

/// Where a window lies and how its voxels are numbered.
///
/// A cell number is 512 times the number of its brick plus its place in the brick, in Morton order.
/// Each axis contributes a summand of its own, so that a step along an axis costs one table lookup.
class WindowGeometry {
 public:
  /// Largest window: 2^31 voxels, that is 256 MiB a layer.
  static constexpr double kMaxCells = 2147483648.0;

  /// The smallest window of whole bricks that contains the box and one voxel around it; false, and
  /// unchanged, when that would have more than `max_cells`. Reuses its memory.
  /// Requires: max_cells <= kMaxCells.
  [[nodiscard]] bool cover(const KeyBox& box, double max_cells);

  [[nodiscard]] std::size_t num_bricks() const noexcept {
    return num_bricks_[0] * num_bricks_[1] * num_bricks_[2];
  }
  /// Key of the window's lower corner along an axis: a multiple of 8, perhaps negative.
  [[nodiscard]] int corner(std::size_t axis) const noexcept { return corner_[axis]; }
  [[nodiscard]] int edge(std::size_t axis) const noexcept {
    return static_cast<int>(num_bricks_[axis] * 8);
  }
  /// Bricks along an axis.
  [[nodiscard]] std::size_t num_bricks(std::size_t axis) const noexcept {
    return num_bricks_[axis];
  }
  /// From the number of a brick to that of the next one along an axis.
  [[nodiscard]] std::size_t brick_stride(std::size_t axis) const noexcept {
    if (axis == 0) return num_bricks_[1] * num_bricks_[2];
    return axis == 1 ? num_bricks_[2] : 1;
  }
  /// Summand of axis `axis` for the voxel at `offset` from the window's corner.
  [[nodiscard]] const std::uint32_t* summands(std::size_t axis) const noexcept {
    return summands_[axis].data();
  }
  /// Requires: offsets within the window.
  [[nodiscard]] std::uint32_t cell(int x, int y, int z) const noexcept {
    return summands_[0][static_cast<std::size_t>(x)] + summands_[1][static_cast<std::size_t>(y)] +
           summands_[2][static_cast<std::size_t>(z)];
  }
  /// Keys of the lower corner of a brick of the window.
  [[nodiscard]] std::array<int, 3> brick_corner(std::size_t brick) const noexcept;

 private:
  std::array<int, 3> corner_{};
  std::array<std::size_t, 3> num_bricks_{};
  std::array<std::vector<std::uint32_t>, 3> summands_;
};

/// Calls `visit(cell)` for each set bit of a brick's 8 words, ascending.
template <class Visitor>
void for_each_bit(const std::uint64_t* words, Visitor&& visit) {
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::uint64_t rest = words[i]; rest != 0; rest &= rest - 1) {
      visit(i * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

/// Sets bits of a layer. Holds plain pointers, so that inner loops keep them in registers.
class BitMarker {
 public:
  BitMarker(std::uint64_t* words, std::uint8_t* touched) noexcept
      : words_(words), touched_(touched) {}
  void mark(std::uint32_t cell) const noexcept {
    words_[cell >> 6U] |= std::uint64_t{1} << (cell & 63U);
    touched_[cell >> 9U] = 1;
  }
  [[nodiscard]] std::uint64_t* words() const noexcept { return words_; }
  [[nodiscard]] std::uint8_t* touched() const noexcept { return touched_; }

 private:
  std::uint64_t* words_;
  std::uint8_t* touched_;
};

/// One bit per cell of a window, and a byte per brick that says whether any may be set.
///
/// All bits are 0 wherever `touched` is 0, from frame to frame: whoever reads a brick clears it.
class BitLayer {
 public:
  /// Makes room for a window. Throws std::bad_alloc. Bits stay 0 when they were.
  void fit(std::size_t num_bricks);

  /// Valid until the next `fit`.
  [[nodiscard]] BitMarker marker() noexcept { return {words_.data(), touched_.data()}; }
  [[nodiscard]] bool test(std::uint32_t cell) const noexcept {
    return ((words_[cell >> 6U] >> (cell & 63U)) & 1U) != 0;
  }
  [[nodiscard]] bool touched(std::size_t brick) const noexcept { return touched_[brick] != 0; }
  [[nodiscard]] const std::uint64_t* words(std::size_t brick) const noexcept {
    return words_.data() + brick * 8;
  }
  [[nodiscard]] std::uint64_t* words(std::size_t brick) noexcept {
    return words_.data() + brick * 8;
  }
  /// Sets all bits that are set in `words`, 8 of them.
  void unite_brick(std::size_t brick, const std::uint64_t* others) noexcept {
    for (std::size_t i = 0; i < 8; ++i) words(brick)[i] |= others[i];
    touched_[brick] = 1;
  }
  void clear_brick(std::size_t brick) noexcept {
    std::fill_n(words(brick), 8, std::uint64_t{0});
    touched_[brick] = 0;
  }
  void clear() noexcept;
  /// Takes all bits of another layer of the same size and clears that.
  void take(BitLayer& other) noexcept;
  /// A byte for each of the bricks from 8 * `group` on: 0 where no bit is set.
  [[nodiscard]] std::uint64_t touched_group(std::size_t group) const noexcept {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, touched_.data() + group * 8, sizeof(bytes));
    return bytes;
  }
  [[nodiscard]] std::size_t num_groups() const noexcept { return touched_.size() / 8; }
  /// Calls `visit(brick)` for each touched brick, ascending.
  template <class Visitor>
  void for_each_touched(Visitor&& visit) const {
    for (std::size_t group = 0; group < num_groups(); ++group) {
      if (touched_group(group) == 0) continue;
      for (std::size_t brick = group * 8; brick < group * 8 + 8; ++brick) {
        if (touched_[brick] != 0) visit(brick);
      }
    }
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<std::uint8_t> touched_;  // a multiple of 8
};

}  // namespace hypermap
