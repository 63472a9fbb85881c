// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/average_precision.hpp"

#include "running_mean.hpp"

#include <algorithm>

namespace hypermap {

std::vector<PrecisionRecallPoint> precision_recall(std::span<const Prediction> predictions,
                                                   std::size_t num_truths) {
  std::vector<Prediction> ranked(predictions.begin(), predictions.end());
  std::sort(ranked.begin(), ranked.end(), [](const Prediction& a, const Prediction& b) {
    return a.probability > b.probability;
  });
  std::vector<PrecisionRecallPoint> curve;
  std::size_t num_true = 0;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    num_true += ranked[i].is_true ? 1U : 0U;
    const bool is_last_of_equals =
        i + 1 == ranked.size() || ranked[i + 1].probability < ranked[i].probability;
    if (!is_last_of_equals) continue;
    const auto found = static_cast<double>(num_true);
    curve.push_back({.probability = ranked[i].probability,
                     .precision = found / static_cast<double>(i + 1),
                     .recall = found / static_cast<double>(num_truths)});
  }
  return curve;
}

std::optional<double> average_precision(std::span<const Prediction> predictions,
                                        std::size_t num_truths) {
  if (num_truths == 0) return std::nullopt;
  double area = 0.0;
  double recall = 0.0;
  for (const PrecisionRecallPoint& point : precision_recall(predictions, num_truths)) {
    area += (point.recall - recall) * point.precision;
    recall = point.recall;
  }
  return area;
}

std::optional<double> mean_average_precision(std::span<const std::optional<double>> of_classes) {
  RunningMean mean;
  for (const auto& of_class : of_classes) {
    if (of_class) mean.add(*of_class);
  }
  return mean.value();
}

}  // namespace hypermap
