// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_grid.hpp"

#include "geometry/floor_of.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFU;
constexpr std::size_t kFewestSlots = 16;
constexpr std::size_t kMostSlotsAtFirst = 4096;

/// Three 21-bit cell numbers in one word.
std::uint64_t key_of(const Eigen::Vector3f& point, double inverse_leaf) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 20U;
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1U;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t cell = floor_of(static_cast<double>(point[axis]) * inverse_leaf);
    const auto shifted = static_cast<std::uint64_t>(cell + kHalf);
    key = (key << 21U) | (shifted & kMask);
  }
  return key;
}

/// Numbers keys 0, 1, 2, ... in the order of their first appearance; open addressing, half full at
/// most. Neighbouring points mostly share a voxel, so the last key is tried first.
class KeyNumbering {
 public:
  /// For about so many keys or fewer: a table of few is cheap to clear.
  explicit KeyNumbering(std::size_t num_keys)
      : slots_(std::bit_ceil(std::clamp(2 * num_keys, kFewestSlots, kMostSlotsAtFirst))) {}

  std::uint32_t number_of(std::uint64_t key) {
    if (count_ > 0 && key == last_.key) return last_.number;
    if (std::size_t{2} * (count_ + 1) > slots_.size()) grow();
    Slot& slot = slot_of(key);
    if (slot.number == kFree) slot = {key, count_++};
    last_ = slot;
    return slot.number;
  }
  [[nodiscard]] std::size_t size() const { return count_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kFree;
  };

  Slot& slot_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    // The upper bits of the product: only they depend on all of the key.
    std::size_t at = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 44U) & mask;
    while (slots_[at].number != kFree && slots_[at].key != key) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old) {
      if (slot.number != kFree) slot_of(slot.key) = slot;
    }
  }

  std::vector<Slot> slots_;
  Slot last_;
  std::uint32_t count_ = 0;
};

}  // namespace

ThinnedCloud voxel_grid(std::span<const Eigen::Vector3f> points, double leaf_size_m) {
  ThinnedCloud grid;
  grid.voxel_of_point.resize(points.size());
  if (leaf_size_m <= 0.0) {
    grid.centroids.assign(points.begin(), points.end());
    std::iota(grid.voxel_of_point.begin(), grid.voxel_of_point.end(), 0U);
    return grid;
  }
  KeyNumbering numbering(points.size());
  std::vector<Eigen::Vector3d> sums;
  std::vector<std::uint32_t> counts;
  const double inverse_leaf = 1.0 / leaf_size_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t voxel = numbering.number_of(key_of(points[i], inverse_leaf));
    if (voxel == sums.size()) {
      sums.emplace_back(Eigen::Vector3d::Zero());
      counts.push_back(0);
    }
    sums[voxel] += points[i].cast<double>();
    ++counts[voxel];
    grid.voxel_of_point[i] = voxel;
  }
  grid.centroids.reserve(sums.size());
  for (std::size_t voxel = 0; voxel < sums.size(); ++voxel) {
    grid.centroids.emplace_back((sums[voxel] / counts[voxel]).cast<float>());
  }
  return grid;
}

std::size_t count_voxels(std::span<const Eigen::Vector3f> points, double leaf_size_m) {
  if (leaf_size_m <= 0.0) return points.size();
  KeyNumbering numbering(points.size());
  const double inverse_leaf = 1.0 / leaf_size_m;
  for (const Eigen::Vector3f& point : points) numbering.number_of(key_of(point, inverse_leaf));
  return numbering.size();
}

}  // namespace hypermap
