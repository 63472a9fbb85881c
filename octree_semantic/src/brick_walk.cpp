// SPDX-License-Identifier: BSD-3-Clause
#include "brick_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

constexpr int kEdge = 8;
/// Bits 0, 1, 2 of 0 .. 7 moved to bits 0, 3, 6: the summand of one axis in Morton order.
constexpr std::array<unsigned, kEdge> kSpread{0, 1, 8, 9, 64, 65, 72, 73};

bool is_occupied(const OccupiedBrick& brick, const std::array<int, 3>& voxel) noexcept {
  const unsigned cell = kSpread[static_cast<std::size_t>(voxel[0])] |
                        kSpread[static_cast<std::size_t>(voxel[1])] << 1U |
                        kSpread[static_cast<std::size_t>(voxel[2])] << 2U;
  return ((brick.occupied[cell >> 6U] >> (cell & 63U)) & 1U) != 0;
}

/// One axis of the walk; lengths in voxels along the ray.
struct Axis {
  int step = 0;
  float next = std::numeric_limits<float>::infinity();
  float per_voxel = std::numeric_limits<float>::infinity();
};

}  // namespace

VoxelBounds bounds_of(const OccupiedBrick& brick) noexcept {
  VoxelBounds bounds{{kEdge, kEdge, kEdge}, {0, 0, 0}};
  for (std::size_t word = 0; word < brick.occupied.size(); ++word) {
    for (std::uint64_t rest = brick.occupied[word]; rest != 0; rest &= rest - 1) {
      const auto cell =
          static_cast<unsigned>(word * 64) + static_cast<unsigned>(std::countr_zero(rest));
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned along = cell >> i;
        const auto at = static_cast<int>((along & 1U) | (along >> 2U & 2U) | (along >> 4U & 4U));
        bounds.min[i] = std::min(bounds.min[i], at);
        bounds.max[i] = std::max(bounds.max[i], at + 1);
      }
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    bounds.min[i] += brick.corner[i];
    bounds.max[i] += brick.corner[i];
  }
  return bounds;
}

bool meets_occupied(const OccupiedBrick& brick,
                    double resolution_m,
                    const WalkedRay& ray) noexcept {
  const auto voxels_per_m = static_cast<float>(1.0 / resolution_m);
  std::array<float, 3> origin{};  // in voxels from the brick's corner
  float first = ray.first * voxels_per_m;
  float last = ray.last * voxels_per_m;
  const float end = last;
  for (std::size_t i = 0; i < 3; ++i) {
    origin[i] = ray.origin[i] * voxels_per_m - static_cast<float>(brick.corner[i]);
    if (ray.direction[i] == 0.0F) continue;
    const float low = -origin[i] / ray.direction[i];
    const float high = (kEdge - origin[i]) / ray.direction[i];
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  // A grazed edge: the walk below starts at the nearest voxel and decides.
  constexpr float kGrazed = 1e-3F;
  if (first > last + kGrazed) return false;
  std::array<int, 3> voxel{};
  std::array<Axis, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    const float entry = origin[i] + ray.direction[i] * first;
    if (entry < -kGrazed || entry > kEdge + kGrazed) return false;
    voxel[i] = std::clamp(static_cast<int>(entry), 0, kEdge - 1);
    if (ray.direction[i] == 0.0F) continue;
    axes[i].step = ray.direction[i] > 0.0F ? 1 : -1;
    const float face = static_cast<float>(voxel[i] + (axes[i].step > 0 ? 1 : 0));
    axes[i].next = (face - origin[i]) / ray.direction[i];
    axes[i].per_voxel = 1.0F / std::abs(ray.direction[i]);
  }
  for (;;) {
    if (is_occupied(brick, voxel)) return true;
    std::size_t axis = axes[0].next <= axes[1].next ? 0 : 1;
    if (axes[2].next < axes[axis].next) axis = 2;
    if (axes[axis].next > end) return false;
    voxel[axis] += axes[axis].step;
    if (voxel[axis] < 0 || voxel[axis] >= kEdge) return false;
    axes[axis].next += axes[axis].per_voxel;
  }
}

}  // namespace hypermap
