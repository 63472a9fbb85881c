// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A meta-classifier that was learnt: for each class of the combined set the probability that it is
/// this one and no other, by what all detectors say.
///
/// Source: [smap] 3.5.3, one against all; learnt by `train_combiner`.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/class_score_combiner.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

class ClassRegistry;
class DetectorRegistry;

/// A detector as it was when the combiner was learnt.
struct CombinedDetector {
  std::string name;
  std::vector<std::string> classes;  ///< That it gives probabilities of.
  friend bool operator==(const CombinedDetector&, const CombinedDetector&) = default;
};

/// One class against all others: its log-odds are the offset and the weighted sum of the features.
struct OneAgainstAll {
  std::string class_name;
  double offset = 0.0;          ///< Log-odds.
  std::vector<double> weights;  ///< One a feature. Log-odds.
  /// Of the examples that it was learnt from, in (0, 1]. What is said is divided by it: a map fuses
  /// many frames, and how common a class is would else count once a frame.
  double share = 1.0;
  friend bool operator==(const OneAgainstAll&, const OneAgainstAll&) = default;
};

/// What was learnt. Features, detector by detector: 1 when it speaks, else 0; then of each of its
/// classes 1 + log10(max(p, 0.001)) / 3, in 0 .. 1, and 0 when it does not speak.
struct CombinerModel {
  std::vector<CombinedDetector> detectors;
  std::vector<OneAgainstAll> classes;

  [[nodiscard]] std::size_t num_features() const;
  friend bool operator==(const CombinerModel&, const CombinerModel&) = default;
};

/// Errors: kInvalidArgument naming the field: no detector or no class, a name that is none or is
/// there twice, weights that are not one a feature, a number that is not finite or beyond 1e6,
/// or a share outside 1e-6 .. 1; kLimit for more than 64 detectors or 4,096 features.
[[nodiscard]] Result<void> validate(const CombinerModel& model);

/// The features of what detectors say, by ids.
class CombinerFeatures {
 public:
  /// Detectors that the registry does not know say nothing; classes that it does not know are
  /// added. Errors: those of ClassRegistry::add.
  [[nodiscard]] static Result<CombinerFeatures> bind(std::span<const CombinedDetector> detectors,
                                                     const DetectorRegistry& registry,
                                                     ClassRegistry& classes);

  [[nodiscard]] bool knows(DetectorId detector) const { return blocks_.contains(detector); }
  /// Words of detectors that it does not know are left out. Requires: as ClassScoreCombiner.
  [[nodiscard]] std::vector<double> of(std::span<const std::vector<ClassEvidence>> likelihoods,
                                       std::span<const DetectorId> detectors) const;

 private:
  struct Block {
    std::size_t first = 0;
    std::map<ClassId, std::size_t> feature_of;
  };
  std::size_t num_features_ = 0;
  std::map<DetectorId, Block> blocks_;
};

/// A model that speaks of the ids of a map. What it says of a class is the probability that the
/// rule gives, as if all its classes had been equally common among the examples (M. Saerens et al.,
/// "Adjusting the outputs of a classifier to new a priori probabilities", 2002). Classes without an
/// example when it was learnt, and what is said when no detector that it knows speaks, keep the
/// mean of what is said of them.
class TrainedCombiner final : public ClassScoreCombiner {
 public:
  /// Adds its classes to `classes`.
  /// Errors: those of validate and ClassRegistry::add; kNotFound when it knows no detector of the
  /// registry.
  [[nodiscard]] static Result<std::shared_ptr<const TrainedCombiner>> bind(
      const CombinerModel& model, const DetectorRegistry& registry, ClassRegistry& classes);

  [[nodiscard]] bool knows(DetectorId detector) const { return features_.knows(detector); }
  [[nodiscard]] Result<std::vector<ClassEvidence>> combine(
      std::span<const std::vector<ClassEvidence>> likelihoods,
      std::span<const DetectorId> detectors) const override;

 private:
  struct Rule {
    ClassId id;
    double offset = 0.0;
    std::vector<double> weights;
    double scale = 1.0;  ///< The mean share of all rules by that of this one.
  };
  TrainedCombiner(CombinerFeatures features, std::vector<Rule> rules)
      : features_(std::move(features)), rules_(std::move(rules)) {}

  CombinerFeatures features_;
  std::vector<Rule> rules_;
};

}  // namespace hypermap
