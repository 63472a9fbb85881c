// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What several detectors say about one image, made into one set of detections.
///
/// Source: [smap] 3.5.3, Eq. (3.14) to (3.16), figure 3.21.
#pragma once

#include "hypermap/core/base/option_table.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/class_score_combiner.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace hypermap {

class DetectorRegistry;

/// How the values of a class that several detectors know become one.
enum class StackingRule {
  kSum,       ///< Their sum: says what any detector says.
  kProduct,   ///< Their product: says what all that know the class say.
  kWeighted,  ///< Their sum weighted by detector.
  kTrained,   ///< What a combiner learnt (StackingModel::combiner).
};

struct StackingOptions {
  /// The operation on the shared cells.
  StackingRule rule = StackingRule::kSum;
  /// Weight of each detector by its name, for kWeighted; one not named has weight 1. No unit.
  std::vector<NamedNumber> weights = {};
  /// Boxes of different detectors that overlap at least so much show the same thing:
  /// intersection over union in the image. No unit.
  double min_overlap = 0.5;

  friend bool operator==(const StackingOptions&, const StackingOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const StackingOptions& options);
[[nodiscard]] const OptionTable& option_table(const StackingOptions& options);

/// What stacking knows of the detectors themselves.
struct StackingModel {
  std::map<DetectorId, double> weights = {};  ///< For kWeighted; one that is not there has 1.
  std::shared_ptr<const ClassScoreCombiner> combiner = {};  ///< For kTrained.
};

/// The weights that `options` gives to detectors of `detectors`. Boundary: other names are left
/// out, see `check_weights`.
[[nodiscard]] StackingModel stacking_model(const StackingOptions& options,
                                           const DetectorRegistry& detectors);

/// What is amiss with the weights, each with the nearest name: names of no detector of `detectors`,
/// and weights where the rule takes none. Field `stacking.weights`.
[[nodiscard]] std::vector<Finding> check_weights(const StackingOptions& options,
                                                 const DetectorRegistry& detectors);

/// One class vector over the combined set: each class once, sorted by id, summing to 1.
///
/// Source: [smap] Eq. (3.14), (3.15), (3.16).
/// Boundary: one vector alone is only normalised. A product whose cells are all 0 (the detectors
/// contradict each other outright) falls back to the sum.
/// Errors: kInvalidArgument when no vector has a sum > 0 after weighting, and by rule kTrained
/// without a combiner; those of the combiner. Requires: `likelihoods` and `detectors` have equal
/// length; each vector names a class once.
[[nodiscard]] Result<std::vector<ClassEvidence>> combine_class_scores(
    std::span<const std::vector<ClassEvidence>> likelihoods,
    std::span<const DetectorId> detectors,
    const StackingOptions& options = {},
    const StackingModel& model = {});

/// Detections of the same object, best score first, at most one of each detector. Greedy by score,
/// then by position. Pointers into `detections`.
[[nodiscard]] std::vector<std::vector<const Detection*>> group_detections(
    std::span<const Detection> detections, double min_overlap);

/// Joins detections of different detectors that show the same object; detections of one detector
/// are never joined with each other.
///
/// The joined detection has the mean box weighted by score, the union of the masks that there are,
/// the highest score, the detector of the best score that named the class which is best of all
/// together (without one, that of the highest score), and of each model the embedding of the member
/// with the best score that has one, at most kMaxEmbeddingModels of them. Groups are those of
/// group_detections: the same result for the same input. Errors: those of combine_class_scores,
/// naming the detection. Cost: O(n^2) in the detections of one image.
[[nodiscard]] Result<std::vector<Detection>> stack_detections(std::span<const Detection> detections,
                                                              const StackingOptions& options = {},
                                                              const StackingModel& model = {});

}  // namespace hypermap
