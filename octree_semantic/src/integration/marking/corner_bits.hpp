// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the corners of voxels to the voxels: bits in Morton order, moved along an axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hypermap {

/// A bit per voxel of a brick, in Morton order.
using BrickWords = std::array<std::uint64_t, 8>;

/// Cells of a word whose place along axis `kAxis` is `place`, 0 .. 3.
template <int kAxis>
[[nodiscard]] constexpr std::uint64_t cells_at(unsigned place) noexcept {
  std::uint64_t cells = 0;
  for (unsigned cell = 0; cell < 64; ++cell) {
    const unsigned along = ((cell >> kAxis) & 1U) | ((cell >> (kAxis + 3)) & 1U) << 1U;
    if (along == place) cells |= std::uint64_t{1} << cell;
  }
  return cells;
}

/// The word whose cell i says what the next cell along the axis says; `next` follows `word`.
template <int kAxis>
[[nodiscard]] constexpr std::uint64_t from_next(std::uint64_t word, std::uint64_t next) noexcept {
  // A step from 0 to 1 or 2 to 3 is one place in Morton order times 2^axis, from 1 to 2 seven, and
  // from 3 to the next word's 0 it is nine back.
  constexpr unsigned kStep = 1U << kAxis;
  constexpr std::uint64_t kEven = cells_at<kAxis>(0) | cells_at<kAxis>(2);
  return ((word >> kStep) & kEven) | ((word >> (7 * kStep)) & cells_at<kAxis>(1)) |
         ((next << (9 * kStep)) & cells_at<kAxis>(3));
}

/// Unites each cell with the next one along the axis; `next` is the brick that follows.
template <int kAxis>
[[nodiscard]] constexpr BrickWords unite_with_next(const BrickWords& brick,
                                                   const BrickWords& next) noexcept {
  constexpr std::size_t kBit = std::size_t{1} << kAxis;
  BrickWords united{};
  for (std::size_t i = 0; i < 8; ++i) {
    const std::uint64_t following = (i & kBit) == 0 ? brick[i | kBit] : next[i & ~kBit];
    united[i] = brick[i] | from_next<kAxis>(brick[i], following);
  }
  return united;
}

/// Voxels of which any of the eight corners is set. `corners[i]`: lower corners of the voxels of
/// the brick (i = 0) and of its neighbours, one further along x (bit 0 of i), y (bit 1) and z (bit
/// 2).
[[nodiscard]] constexpr BrickWords voxels_of_corners(
    const std::array<const BrickWords*, 8>& corners) noexcept {
  std::array<BrickWords, 4> along_x{};
  for (std::size_t i = 0; i < 4; ++i) {
    along_x[i] = unite_with_next<0>(*corners[2 * i], *corners[2 * i + 1]);
  }
  return unite_with_next<2>(unite_with_next<1>(along_x[0], along_x[1]),
                            unite_with_next<1>(along_x[2], along_x[3]));
}

}  // namespace hypermap
