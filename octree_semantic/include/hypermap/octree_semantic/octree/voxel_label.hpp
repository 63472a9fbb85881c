// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which class and which object a voxel belongs to, in 20 bytes.
///
/// Each class c has log-odds l_c, and a frame that saw the voxel adds logit(p_c) - logit(1/N), N
/// being the number of classes the detector chose from. At the upper bound all are lowered alike,
/// as those of an object are: clamped one by one, two similar classes would end as equals. Source:
/// [smap] Eq. (3.18), as for objects; SSMI (A. Asgharivaskasi, N. Atanasov, "Semantic octree
/// mapping and Shannon mutual information computation", T-RO 2023) for keeping the top classes.
/// Deviation: only the three best classes are kept. All others share `rest`, which is never below
/// their true value while each frame's vector names every class: so a class is overrated by at most
/// the difference, and up to three classes are exact. Where the best is at the upper bound, others
/// may be underrated by what it is overrated.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/octree_semantic/octree/sensor_model.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace hypermap {

/// A class and its log-odds in a voxel.
struct ClassWeight {
  /// "No class": never the id of one.
  static constexpr std::uint16_t kNone = 0xFFFF;

  std::uint16_t class_id = kNone;
  MilliLogOdds log_odds = 0;
  friend bool operator==(const ClassWeight&, const ClassWeight&) = default;
};

/// Belief over classes and the object of one voxel. A value of 20 bytes.
struct VoxelLabel {
  static constexpr std::size_t kNumClasses = 3;

  /// The best classes, best first, the lower id first among equals; unused ones stand at the end.
  std::array<ClassWeight, kNumClasses> classes;
  /// Upper bound of the log-odds of every class not in `classes`.
  MilliLogOdds rest = 0;
  /// Frames that voted for `object` minus frames that voted for others, 0 .. 10.
  std::uint16_t object_votes = 0;
  /// Majority of the frames that named an object; kNoObject when none did.
  ObjectId object = kNoObject;

  /// The most probable class; none when no class is more probable than it was a priori.
  [[nodiscard]] std::optional<ClassId> best_class() const noexcept {
    if (classes[0].class_id == ClassWeight::kNone || classes[0].log_odds <= 0) return std::nullopt;
    return ClassId{classes[0].class_id};
  }
  /// Counts one frame's vote for an object, so that the majority of frames wins (R. S. Boyer and
  /// J. S. Moore, "MJRTY", 1991), and ten votes are remembered at most. kNoObject is no vote.
  void vote(ObjectId id) noexcept;
  friend bool operator==(const VoxelLabel&, const VoxelLabel&) = default;
};
static_assert(sizeof(VoxelLabel) == 20);

/// What two labels of one voxel say together, each of frames that the other does not have: evidence
/// adds up, that of a class which one of them does not keep being its `rest`; the best three stay,
/// and all are lowered alike where the best exceeds `limit`. Votes for one object add up, those for
/// two are held against each other: the one with more stays, of equals the lower id.
///
/// Boundary: the order of the two does not matter. That of three does, where more than three
/// classes were named, votes were forgotten or evidence reached the limit.
[[nodiscard]] VoxelLabel sum_of(const VoxelLabel& a, const VoxelLabel& b, MilliLogOdds limit);

/// Errors: kInvalidArgument naming what breaks the rules above: order, gaps, a class twice, votes
/// without an object or more than ten, or log-odds beyond +-`limit`.
[[nodiscard]] Result<void> validate(const VoxelLabel& label, MilliLogOdds limit);

}  // namespace hypermap
