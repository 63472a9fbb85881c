// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is known of an object's class besides its detections: outside knowledge, as of the place
/// that it is in.
///
/// Source: [smap] Eq. (3.17), p(x).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/class_belief.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// How many times as probable each class is as without the knowledge. A value. Default: it says
/// nothing, all factors are 1.
class ClassPrior {
 public:
  ClassPrior() = default;

  /// Factors as their natural logarithms; classes that are not named have 1.
  /// Errors: kInvalidArgument when ids do not ascend or a logarithm is beyond +- kMaxLogFactor.
  [[nodiscard]] static Result<ClassPrior> create(std::vector<ClassLogOdds> log_factors);

  [[nodiscard]] double factor(ClassId id) const;
  /// In ascending order of ids.
  [[nodiscard]] std::span<const ClassLogOdds> log_factors() const noexcept { return log_factors_; }
  [[nodiscard]] bool empty() const noexcept { return log_factors_.empty(); }

  static constexpr double kMaxLogFactor = 20.0;

  friend bool operator==(const ClassPrior&, const ClassPrior&) = default;

 private:
  std::vector<ClassLogOdds> log_factors_;
};

/// The classes with the knowledge: each probability times its factor, normalised to the sum that
/// was given.
///
/// Source: [smap] Eq. (3.17); under tempering none (3.18) observes the result. Boundary: a prior
/// that says nothing changes no bit. Cost: linear, times the logarithm of the prior's classes.
[[nodiscard]] std::vector<ClassEvidence> with_prior(std::vector<ClassEvidence> classes,
                                                    const ClassPrior& prior);

}  // namespace hypermap
