// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The unit of storage of the 3D map: 8 x 8 x 8 voxels that lie together.
///
/// Voxels stand in Morton order within the brick, so 8 successive ones are a cube of 2 x 2 x 2 and
/// 64 (one word) a cube of 4 x 4 x 4: the lowest three levels of OctoMap's tree.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/octree_semantic/octree/sensor_model.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace hypermap {

/// One bit for each voxel of a brick.
struct alignas(64) BrickBits {
  std::array<std::uint64_t, 8> words{};

  [[nodiscard]] bool test(std::size_t cell) const noexcept {
    return ((words[cell >> 6U] >> (cell & 63U)) & 1U) != 0;
  }
  void set(std::size_t cell) noexcept { words[cell >> 6U] |= std::uint64_t{1} << (cell & 63U); }
  void reset(std::size_t cell) noexcept {
    words[cell >> 6U] &= ~(std::uint64_t{1} << (cell & 63U));
  }
  [[nodiscard]] bool any() const noexcept {
    std::uint64_t all = 0;
    for (const std::uint64_t word : words) all |= word;
    return all != 0;
  }
  [[nodiscard]] int count() const noexcept {
    int total = 0;
    for (const std::uint64_t word : words) total += std::popcount(word);
    return total;
  }
  /// How many bits are set before `cell`.
  [[nodiscard]] std::size_t rank(std::size_t cell) const noexcept {
    std::size_t before = 0;
    for (std::size_t i = 0; i < (cell >> 6U); ++i) {
      before += static_cast<std::size_t>(std::popcount(words[i]));
    }
    const std::uint64_t below = (std::uint64_t{1} << (cell & 63U)) - 1;
    return before + static_cast<std::size_t>(std::popcount(words[cell >> 6U] & below));
  }
  /// Calls `visit(cell)` for each set bit, in Morton order.
  template <class Visitor>
  void for_each(Visitor&& visit) const {
    for (std::size_t i = 0; i < words.size(); ++i) {
      for (std::uint64_t rest = words[i]; rest != 0; rest &= rest - 1) {
        visit(i * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
      }
    }
  }
  friend bool operator==(const BrickBits&, const BrickBits&) = default;
};

/// Labels of a brick, present only for voxels in which something labelled was hit.
class LabelTable {
 public:
  [[nodiscard]] const BrickBits& labelled() const noexcept { return labelled_; }
  [[nodiscard]] std::size_t size() const noexcept { return labels_.size(); }
  [[nodiscard]] const VoxelLabel* find(std::size_t cell) const noexcept {
    return labelled_.test(cell) ? &labels_[labelled_.rank(cell)] : nullptr;
  }
  [[nodiscard]] VoxelLabel* find(std::size_t cell) noexcept {
    return labelled_.test(cell) ? &labels_[labelled_.rank(cell)] : nullptr;
  }
  /// The label of `cell`, a blank one when it had none. No allocation within reserved capacity.
  VoxelLabel& at(std::size_t cell);
  /// Makes room for `num_new` more labels, so that `at` cannot throw.
  void reserve_more(std::size_t num_new);
  void erase(std::size_t cell) noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return sizeof(*this) + labels_.capacity() * sizeof(VoxelLabel);
  }
  friend bool operator==(const LabelTable&, const LabelTable&) = default;

 private:
  BrickBits labelled_;
  std::vector<VoxelLabel> labels_;  // one per set bit, in order of the bits
};

class BrickPool;

/// Occupancy and labels of 512 voxels. Unknown voxels have log-odds 0 and no `known` bit.
struct Brick {
  BrickBits known;
  /// Known and at least as probable as the sensor model's threshold: kept in step with `log_odds`.
  BrickBits occupied;
  alignas(64) std::array<MilliLogOdds, kBrickVolume> log_odds{};
  std::unique_ptr<LabelTable> labels;  ///< Null where nothing labelled was hit.
  BrickPool* home = nullptr;           ///< Where it goes when nobody owns it; null: it is freed.
  Brick* next_idle = nullptr;          ///< Of the bricks that its pool keeps.
  OwnerCount owners;

  Brick() = default;
  /// The same content, of no pool.
  Brick(const Brick& other);
  Brick& operator=(const Brick&) = delete;
  Brick(Brick&&) = delete;
  Brick& operator=(Brick&&) = delete;
  ~Brick() = default;

  [[nodiscard]] const VoxelLabel* label(std::size_t cell) const noexcept {
    return labels ? std::as_const(*labels).find(cell) : nullptr;
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return sizeof(*this) + (labels ? labels->memory_bytes() : 0);
  }
  static void dispose(Brick* brick) noexcept;
};

/// Shared ownership of a brick. Copies of a map share their bricks until one of them is written.
using BrickRef = CowRef<Brick>;

/// Same voxels known, with the same log-odds and labels; a blank label is none.
[[nodiscard]] bool same_content(const Brick& a, const Brick& b) noexcept;

/// Same voxels known, with the same log-odds, and neither has labels.
[[nodiscard]] bool same_unlabelled(const Brick& a, const Brick& b) noexcept;

}  // namespace hypermap
