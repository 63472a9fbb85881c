// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What became of the objects of one map and of the truth, class by class: the numbers from which
/// the rates of one run or of several are made.
///
/// Source: [smap] chapter 5, appendices B and E.1; docs/EVALUATION.md, "Rates".
#pragma once

#include "hypermap/core/evaluation/binary_counts.hpp"
#include "hypermap/core/evaluation/calibration.hpp"
#include "hypermap/core/geometry/turned_box.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// An object of a map. Frame: Map.
struct RatedObject {
  std::uint64_t id = 0;
  std::string class_name = {};                           ///< Canonical.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();       ///< What a distance is taken from.
  std::optional<Eigen::Vector3d> centre = std::nullopt;  ///< Of its box.
  std::optional<TurnedBox> box = std::nullopt;
  bool is_confirmed = true;
  std::optional<double> confidence = std::nullopt;  ///< None: the map has no beliefs.
  bool is_apart = false;  ///< Confirmed, and at a truth that does not count: not rated.
};

/// What really stands there. Frame: Map.
struct RatedTruth {
  std::string reference = {};                 ///< Its name, the same in all runs.
  std::vector<std::string> class_names = {};  ///< Canonical, all right; counted by the first.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double gate_m = 0.0;  ///< Objects farther away are not it.
  std::optional<Eigen::Vector3d> centre = std::nullopt;
  std::optional<TurnedBox> box = std::nullopt;
  bool counts = true;
  std::optional<std::size_t> object = std::nullopt;  ///< Index of the confirmed object that it is.
};

/// Objects of any class that are something real with a class that the detector can name.
struct Classifications {
  std::size_t num_all = 0;
  std::size_t num_right = 0;
  /// ACC of several classes. None without any. Source: [smap] Eq. (B.5), its first form.
  [[nodiscard]] std::optional<double> accuracy() const;
  Classifications& operator+=(const Classifications& other);
  friend bool operator==(const Classifications&, const Classifications&) = default;
};

/// How well shapes and voxels of a map fit, told by whoever compares them; none: not known.
struct RunFit {
  /// Mean over the footprints that count, 0 where nothing is found.
  std::optional<double> jaccard_in_place = std::nullopt;
  std::optional<double> label_precision = std::nullopt;  ///< Of the labelled voxels.
  std::optional<double> label_recall = std::nullopt;     ///< Of the voxels at what has a class.
  friend bool operator==(const RunFit&, const RunFit&) = default;
};

struct RatedRun {
  std::vector<RatedObject> objects = {};
  std::vector<RatedTruth> truths = {};
  Classifications classifications = {};
  bool has_tentative = true;  ///< The map keeps what it rejects, so true negatives can be counted.
  RunFit fit = {};
};

/// When an object may be a truth of its class in a ranking.
enum class MatchCriterion : std::uint8_t {
  kDistance,   ///< Its place is within the truth's gate.
  kOverlap25,  ///< The boxes overlap by an intersection over union of 0.25 and more,
  kOverlap50,  ///< and of 0.5 and more.
};
inline constexpr std::array<MatchCriterion, 3> kMatchCriteria{
    MatchCriterion::kDistance, MatchCriterion::kOverlap25, MatchCriterion::kOverlap50};

/// One word each, for output: "gate", "iou25", "iou50".
[[nodiscard]] std::string_view key_of(MatchCriterion criterion);

/// What one run has of one class.
struct ClassRun {
  BinaryCounts counts = {};
  /// By criterion: confidence of each object, tentative ones too, and whether it is right.
  std::array<std::vector<Prediction>, kMatchCriteria.size()> ranked = {};
  std::vector<Eigen::Vector3d> errors_m = {};  ///< True minus mapped centre of each match.
  std::vector<double> overlaps = {};           ///< Intersection over union of their boxes.

  [[nodiscard]] std::size_t num_truths() const {
    return counts.true_positives + counts.false_negatives;
  }
};

/// What one run has of one truth.
struct TruthRun {
  std::string reference = {};
  std::string class_name = {};
  bool counts = true;
  std::optional<std::uint64_t> object_id = std::nullopt;  ///< Of the object that it is.
  std::optional<Eigen::Vector3d> true_centre = std::nullopt;
  std::optional<Eigen::Vector3d> centre = std::nullopt;
  std::optional<Eigen::Vector3d> error_m = std::nullopt;  ///< True minus mapped.
  std::optional<double> overlap = std::nullopt;
};

/// An object that is nothing real: a false positive.
struct FalseObject {
  std::uint64_t object_id = 0;
  std::string class_name = {};
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::optional<double> confidence = std::nullopt;
};

struct RunRates {
  std::map<std::string, ClassRun> classes = {};  ///< By canonical name.
  std::vector<TruthRun> truths = {};             ///< In the order of the run's truths.
  std::vector<FalseObject> false_objects = {};   ///< In the order of the run's objects.
  Classifications classifications = {};
  bool has_confidences = true;  ///< Of all objects, so that they can be ranked.
  RunFit fit = {};              ///< As the run has it.
};

/// Positives are the truths that count, negatives all objects of the map that are none: a confirmed
/// one is a false positive, a tentative one a true negative, since the map did not take it for
/// there. A tentative object within the gate of a truth of its class that nobody is, one to one at
/// the least sum of distances, is neither: the truth is missed, a false negative, or does not
/// count.
///
/// In a ranking objects choose in the order of their confidence, each the best truth of its class
/// that is left (nearest, or of the largest overlap); equals together, as many as possible, at the
/// least cost. One that finds only a truth that does not count, by the criterion or by distance, is
/// left out, one that finds none is wrong. The order of objects and of truths changes nothing.
///
/// Source: [smap] B.1, 5.3. Deviation: the text counts no negatives, since nobody could tell what
/// should not have been registered; here the rejected candidates tell.
/// An object that is right by a further class of a truth counts, and is ranked, in the truth's.
/// Requires: `object` of each truth is a confirmed object that is not apart, of no two truths; no
/// truth has a class twice.
/// Boundary: without `has_tentative` true negatives are none; with an object without confidence
/// nothing is ranked. Cost: O(n m) per class for n objects and m truths, O(n^3) for equals.
[[nodiscard]] RunRates run_rates(const RatedRun& run);

}  // namespace hypermap
