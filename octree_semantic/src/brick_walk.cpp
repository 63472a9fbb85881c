// SPDX-License-Identifier: BSD-3-Clause
#include "brick_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

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

/// A grazed edge: the walk starts at the nearest voxel and decides.
constexpr float kGrazed = 1e-3F;

/// A ray in voxels from the brick's corner.
struct LocalRay {
  std::array<float, 3> origin{};
  std::array<float, 3> direction{};
  float first = 0.0F;  // where it enters the brick
  float last = 0.0F;   // where it leaves the brick
  float end = 0.0F;    // where it ends
};

LocalRay clipped(const OccupiedBrick& brick, double resolution_m, const WalkedRay& ray) noexcept {
  const auto voxels_per_m = static_cast<float>(1.0 / resolution_m);
  LocalRay local{.origin = {},
                 .direction = ray.direction,
                 .first = ray.first * voxels_per_m,
                 .last = ray.last * voxels_per_m,
                 .end = ray.last * voxels_per_m};
  for (std::size_t i = 0; i < 3; ++i) {
    local.origin[i] = ray.origin[i] * voxels_per_m - static_cast<float>(brick.corner[i]);
    if (ray.direction[i] == 0.0F) continue;
    const float low = -local.origin[i] / ray.direction[i];
    const float high = (kEdge - local.origin[i]) / ray.direction[i];
    local.first = std::max(local.first, std::min(low, high));
    local.last = std::min(local.last, std::max(low, high));
  }
  return local;
}

/// The voxel at which the ray enters the brick and where it passes the next faces.
struct Walk {
  std::array<int, 3> voxel{};
  std::array<int, 3> step{};
  std::array<float, 3> next;
  std::array<float, 3> per_voxel{};
};

/// None when the ray passes the brick by.
std::optional<Walk> start_walk(const LocalRay& ray) noexcept {
  if (ray.first > ray.last + kGrazed) return std::nullopt;
  Walk walk;
  walk.next.fill(std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < 3; ++i) {
    const float entry = ray.origin[i] + ray.direction[i] * ray.first;
    if (entry < -kGrazed || entry > kEdge + kGrazed) return std::nullopt;
    walk.voxel[i] = std::clamp(static_cast<int>(entry), 0, kEdge - 1);
    if (ray.direction[i] == 0.0F) continue;
    walk.step[i] = ray.direction[i] > 0.0F ? 1 : -1;
    const auto face = static_cast<float>(walk.voxel[i] + (walk.step[i] > 0 ? 1 : 0));
    walk.next[i] = (face - ray.origin[i]) / ray.direction[i];
    walk.per_voxel[i] = 1.0F / std::abs(ray.direction[i]);
  }
  return walk;
}

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
  const LocalRay local = clipped(brick, resolution_m, ray);
  std::optional<Walk> walk = start_walk(local);
  if (!walk) return false;
  auto& [voxel, step, next, per_voxel] = *walk;
  for (;;) {
    if (is_occupied(brick, voxel)) return true;
    std::size_t axis = next[0] <= next[1] ? 0 : 1;
    if (next[2] < next[axis]) axis = 2;
    if (next[axis] > local.end) return false;
    voxel[axis] += step[axis];
    if (voxel[axis] < 0 || voxel[axis] >= kEdge) return false;
    next[axis] += per_voxel[axis];
  }
}

}  // namespace hypermap
