// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Counts, for each voxel hit in a frame, how many measurements of each label ended in it.
#pragma once

#include "octree/brick.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// How many measurements of one label ended in a voxel.
struct LabelVote {
  std::uint32_t label = 0;  ///< Position among the frame's labels.
  std::uint32_t count = 0;
};

/// Votes of one frame. The order in which measurements are added does not matter.
///
/// Two labels per voxel are counted in place, further ones (where three objects meet) in a list.
/// Where labelled voxels lie far apart all are counted in the list: places take 8 KiB a brick.
class LabelVotes {
 public:
  enum class Storage : std::uint8_t { kInPlace, kList };
  /// Forgets all and makes room for `num_bricks`. Throws std::bad_alloc.
  void start(std::size_t num_bricks, std::size_t num_labels, Storage storage = Storage::kInPlace);
  /// `count` measurements of `label` ended in `cell`. Throws std::bad_alloc.
  void add(std::uint32_t cell, std::uint32_t label, std::uint32_t count);
  /// Call once after the last `add`.
  void finish();

  /// Voxels of a brick that have votes; null when none has.
  [[nodiscard]] const BrickBits* labelled(std::size_t brick) const noexcept {
    const std::uint32_t slab = slab_of_brick_[brick];
    return slab == kNoSlab ? nullptr : &slabs_[slab].labelled;
  }
  /// Votes of a voxel, by ascending label. Valid until the next call.
  /// Requires: the voxel is labelled.
  [[nodiscard]] std::span<const LabelVote> votes(std::size_t brick, std::size_t cell) noexcept;

  /// What a brick and a vote take at most in storage kList.
  static constexpr std::size_t kListBytesPerBrick = 256;
  static constexpr std::size_t kListBytesPerVote = 24;

 private:
  static constexpr std::uint32_t kNoSlab = 0xFFFF'FFFF;
  struct Slab {
    BrickBits labelled;
    std::size_t brick = 0;
  };
  using Places = std::array<std::array<LabelVote, 2>, kBrickVolume>;  // count 0: unused
  struct FurtherVote {
    std::uint32_t cell = 0;
    std::uint32_t label = 0;
    std::uint32_t count = 0;
    friend auto operator<=>(const FurtherVote&, const FurtherVote&) = default;
  };
  [[nodiscard]] std::size_t slab(std::size_t brick);
  /// Whether the vote found a place.
  [[nodiscard]] bool add_in_place(std::size_t slab, std::size_t cell, const LabelVote& vote);

  Storage storage_ = Storage::kInPlace;
  std::vector<std::uint32_t> slab_of_brick_;
  std::vector<Slab> slabs_;
  std::vector<Places> places_;  // one per slab, or none
  std::size_t num_slabs_ = 0;   // in use; the others keep their memory
  std::vector<FurtherVote> further_;
  std::vector<LabelVote> gathered_;
};

}  // namespace hypermap
