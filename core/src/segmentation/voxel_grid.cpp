// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/voxel_grid.hpp"

#include <bit>
#include <cmath>
#include <numeric>

namespace hypermap {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFU;

/// Three 21-bit cell numbers in one word.
std::uint64_t key_of(const Eigen::Vector3f& point, double inverse_leaf) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 20U;
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1U;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(static_cast<double>(point[axis]) * inverse_leaf);
    const auto shifted = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + kHalf);
    key = (key << 21U) | (shifted & kMask);
  }
  return key;
}

/// Numbers keys 0, 1, 2, ... in the order of their first appearance; open addressing.
class KeyNumbering {
 public:
  explicit KeyNumbering(std::size_t num_points)
      : slots_(std::bit_ceil(2 * num_points + 2), Slot{0, kFree}) {}

  std::uint32_t number_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 20U) & mask;
    while (slots_[at].number != kFree && slots_[at].key != key) at = (at + 1) & mask;
    if (slots_[at].number == kFree) slots_[at] = {key, count_++};
    return slots_[at].number;
  }

 private:
  struct Slot {
    std::uint64_t key;
    std::uint32_t number;
  };
  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

}  // namespace

VoxelGrid voxel_grid(std::span<const Eigen::Vector3f> points, double leaf_size_m) {
  VoxelGrid grid;
  grid.voxel_of_point.resize(points.size());
  if (leaf_size_m <= 0.0) {
    grid.centroids.assign(points.begin(), points.end());
    std::iota(grid.voxel_of_point.begin(), grid.voxel_of_point.end(), 0U);
    return grid;
  }
  KeyNumbering numbering(points.size());
  std::vector<Eigen::Vector3d> sums;
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t voxel = numbering.number_of(key_of(points[i], 1.0 / leaf_size_m));
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

}  // namespace hypermap
