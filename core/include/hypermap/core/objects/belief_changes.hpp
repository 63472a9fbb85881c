// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which classes an observation made more or less believed, beside the one that it named.
///
/// Ours: a part of the answer to "why is this in the map?".
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/class_belief.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace hypermap {

/// Change of the belief in one class.
struct BeliefChange {
  ClassId class_id = {};
  float log_odds = 0.0F;  ///< To 0.001.
  friend bool operator==(const BeliefChange&, const BeliefChange&) = default;
};

/// The largest changes of an object's beliefs by one observation, at most `kMaxClasses` of them.
/// A value of 32 bytes that allocates nothing.
class BeliefChanges {
 public:
  static constexpr std::size_t kMaxClasses = 4;
  /// Smaller changes are left out. Unit: log-odds.
  static constexpr double kLeastLogOdds = 0.1;

  BeliefChanges() = default;

  /// Between two states of one belief, without that in the class `named`. Of changes that are the
  /// same to 0.001 those of the classes that were believed more before are kept, then those of
  /// lower ids: a detector that spreads what it leaves over all other classes changes them alike.
  /// Boundary: a class that `before` lacks was believed by 0. Cost: linear in `after`.
  /// Requires: both ascend by id, `after` has the classes of `before`.
  [[nodiscard]] static BeliefChanges between(std::span<const ClassLogOdds> before,
                                             std::span<const ClassLogOdds> after,
                                             ClassId named);

  /// Restores stored ones. Errors: kInvalidArgument: more than kMaxClasses, a class twice, a change
  /// that is 0 or not finite, a larger one behind a smaller one.
  [[nodiscard]] static Result<BeliefChanges> from_entries(std::span<const BeliefChange> entries);

  /// The same observation changed more: of each class the sum. A class that either of them left out
  /// counts 0 there.
  void add(const BeliefChanges& later);

  /// The largest first.
  [[nodiscard]] std::span<const BeliefChange> entries() const noexcept;
  [[nodiscard]] bool contains(ClassId id) const noexcept;
  friend bool operator==(const BeliefChanges&, const BeliefChanges&) = default;

 private:
  /// Behind those that are as large. Drops the smallest when there are too many.
  void insert(const BeliefChange& change);

  std::array<BeliefChange, kMaxClasses> changes_ = {};  ///< Unused ones, of 0, are the last.
};

}  // namespace hypermap
