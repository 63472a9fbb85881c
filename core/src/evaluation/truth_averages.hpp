// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the one-to-one metric says of the truths that count, on average.
#pragma once

#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "running_mean.hpp"

namespace hypermap {

class TruthAverages {
 public:
  explicit TruthAverages(const EvaluationOptions& options) : options_(options) {}

  /// Requires: a truth that is not excluded.
  void add(const EvaluatedObject& truth, const TruthResult& result);
  void write_to(OneToOneMetric& metric) const;

 private:
  const EvaluationOptions& options_;
  RunningMean distances_;
  RunningMean judged_;
  RunningMean small_;
  RunningMean seen_;
  RunningMean covered_;
  RunningMean box_ious_;
  std::optional<double> worst_;
};

}  // namespace hypermap
