// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How well the confidence of objects orders them: right ones before wrong ones.
///
/// Source: [smap] B.4, B.5.
#pragma once

#include "hypermap/core/evaluation/calibration.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// What is right and found when all that is at least so probable is taken for there.
struct PrecisionRecallPoint {
  double probability = 0.0;
  double precision = 0.0;
  double recall = 0.0;
  friend bool operator==(const PrecisionRecallPoint&, const PrecisionRecallPoint&) = default;
};

/// The curve of precision over recall, a point for each probability that occurs, falling. Equal
/// probabilities are one point, so the order of the predictions does not matter.
///
/// Requires: num_truths > 0, no more true predictions than that, no probability is NaN.
/// Boundary: no predictions give no points. Cost: O(n log n).
[[nodiscard]] std::vector<PrecisionRecallPoint> precision_recall(
    std::span<const Prediction> predictions, std::size_t num_truths);

/// AP: the area under that curve, as the sum over its points of the gain in recall times the
/// precision there, without interpolation.
///
/// Source: [smap] Eq. (B.7), Eq. (B.8), where k counts points of the curve.
/// Boundary: none without truths; 0 when none of them is found. Requires and cost: as above.
[[nodiscard]] std::optional<double> average_precision(std::span<const Prediction> predictions,
                                                      std::size_t num_truths);

/// mAP: the mean over the classes that have one. Source: [smap] Eq. (B.9), which prints AP for its
/// left side. Boundary: none when no class has one.
[[nodiscard]] std::optional<double> mean_average_precision(
    std::span<const std::optional<double>> of_classes);

}  // namespace hypermap
