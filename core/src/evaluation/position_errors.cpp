// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/position_errors.hpp"

#include <cmath>

namespace hypermap {

PositionErrorSummary summarised(std::span<const Eigen::Vector3d> errors_m) {
  PositionErrorSummary summary{.n = errors_m.size()};
  if (errors_m.empty()) return summary;
  const auto n = static_cast<double>(errors_m.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double distances = 0.0;
  for (const Eigen::Vector3d& error : errors_m) {
    sum += error;
    squares += error.cwiseProduct(error);
    distances += error.norm();
  }
  const double mean_distance = distances / n;
  summary.mean_m = sum / n;
  summary.mean_distance_m = mean_distance;
  summary.rmse_m = (squares / n).cwiseSqrt();
  summary.total_rmse_m = std::sqrt(squares.sum() / n);
  if (errors_m.size() < 2) return summary;
  double deviations = 0.0;
  for (const Eigen::Vector3d& error : errors_m)
    deviations += (error.norm() - mean_distance) * (error.norm() - mean_distance);
  summary.std_distance_m = std::sqrt(deviations / (n - 1.0));
  return summary;
}

}  // namespace hypermap
