// SPDX-License-Identifier: BSD-3-Clause
#include "bit_window.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// Largest multiple of 8 that is not larger.
int round_down_to_brick(int key) {
  return (key >> 3) * 8;
}

/// Bits 0, 1, 2 of `offset` moved to bits 0, 3, 6.
std::uint32_t spread_in_brick(std::size_t offset) {
  return static_cast<std::uint32_t>((offset & 1U) | (offset & 2U) << 2U | (offset & 4U) << 4U);
}

}  // namespace

bool WindowGeometry::cover(const KeyBox& box, double max_cells) {
  std::array<int, 3> corner{};
  std::array<std::size_t, 3> num_bricks{};
  double num_cells = 512.0;
  for (std::size_t i = 0; i < 3; ++i) {
    corner[i] = round_down_to_brick(box.min[i] - 1);
    num_bricks[i] = static_cast<std::size_t>(box.max[i] + 1 - corner[i]) / 8 + 1;
    num_cells *= static_cast<double>(num_bricks[i]);
  }
  if (num_cells > max_cells) return false;
  corner_ = corner;
  num_bricks_ = num_bricks;
  for (std::size_t i = 0; i < 3; ++i) {
    summands_[i].resize(num_bricks[i] * 8);
    for (std::size_t offset = 0; offset < summands_[i].size(); ++offset) {
      const auto brick = static_cast<std::uint32_t>(offset / 8 * brick_stride(i));
      summands_[i][offset] = brick << 9U | spread_in_brick(offset) << i;
    }
  }
  return true;
}

std::array<int, 3> WindowGeometry::brick_corner(std::size_t brick) const noexcept {
  const std::size_t z = brick % num_bricks_[2];
  const std::size_t y = brick / num_bricks_[2] % num_bricks_[1];
  const std::size_t x = brick / num_bricks_[2] / num_bricks_[1];
  return {corner_[0] + static_cast<int>(x * 8),
          corner_[1] + static_cast<int>(y * 8),
          corner_[2] + static_cast<int>(z * 8)};
}

void BitLayer::fit(std::size_t num_bricks) {
  if (num_bricks <= touched_.size()) return;
  const std::size_t whole_groups = (num_bricks + 7) / 8 * 8;
  words_.resize(whole_groups * 8);
  touched_.resize(whole_groups);
}

void BitLayer::clear() noexcept {
  for_each_touched([this](std::size_t brick) { clear_brick(brick); });
}

void BitLayer::take(BitLayer& other) noexcept {
  other.for_each_touched([&](std::size_t brick) {
    unite_brick(brick, other.words(brick));
    other.clear_brick(brick);
  });
}

}  // namespace hypermap
