// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Learns how to combine what several detectors say from examples whose class is known.
///
/// Source: [smap] 3.5.3, a meta-classifier trained one against all. Each class has a linear support
/// vector machine (OpenCV's) against all others, whose distance becomes a probability by a sigmoid:
/// J. Platt, "Probabilistic outputs for support vector machines", 1999.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/core/segmentation/trained_combiner.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What detectors said of one object, and what it is.
struct CombinerExample {
  std::vector<std::vector<ClassEvidence>> likelihoods;
  std::vector<DetectorId> detectors;  ///< Whose each is; each at most once.
  ClassId truth;
};

struct CombinerTrainingOptions {
  double penalty = 1.0;  ///< Of an example on the wrong side (C of the SVM). Weight, 0.001 .. 1000
  std::size_t min_examples = 5;  ///< A class with fewer keeps the mean. Range: 1 .. 1,000,000
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const CombinerTrainingOptions& options);
[[nodiscard]] const OptionTable& option_table(const CombinerTrainingOptions& options);

/// A detector's classes are those that it gave some probability of. How common a class is among the
/// examples is kept beside its rule and taken out of what it says (`OneAgainstAll::share`): a map
/// asks of every frame anew, and many examples of chairs must not make a sofa one.
///
/// The same bytes for the same examples on any number of threads.
/// Errors: those of validate, of the options and of what is learnt; kInvalidArgument when no class
/// has `min_examples`, or one class has all examples; kUnavailable when OpenCV fails.
/// Cost: classes times examples squared times features at worst.
/// Requires: the ids are of the registries.
[[nodiscard]] Result<CombinerModel> train_combiner(std::span<const CombinerExample> examples,
                                                   const DetectorRegistry& detectors,
                                                   const ClassRegistry& classes,
                                                   const CombinerTrainingOptions& options = {});

}  // namespace hypermap
