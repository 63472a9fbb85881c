// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How class vectors that several detectors give of one object become one, where no fixed rule does
/// it.
///
/// Source: [smap] 3.5.3, the meta-classifier.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// A meta-classifier. Threads: `combine` is called concurrently.
class ClassScoreCombiner {
 public:
  ClassScoreCombiner() = default;
  ClassScoreCombiner(const ClassScoreCombiner&) = delete;
  ClassScoreCombiner& operator=(const ClassScoreCombiner&) = delete;
  ClassScoreCombiner(ClassScoreCombiner&&) = delete;
  ClassScoreCombiner& operator=(ClassScoreCombiner&&) = delete;
  virtual ~ClassScoreCombiner() = default;

  /// One class vector: each class once, sorted by id, summing to 1. The same for the same input.
  ///
  /// Errors: kInvalidArgument when nothing is said. Requires: `likelihoods` and `detectors` have
  /// equal length; each vector names a class once, no detector is there twice.
  [[nodiscard]] virtual Result<std::vector<ClassEvidence>> combine(
      std::span<const std::vector<ClassEvidence>> likelihoods,
      std::span<const DetectorId> detectors) const = 0;
};

}  // namespace hypermap
