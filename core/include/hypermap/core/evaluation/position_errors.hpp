// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far from the truth positions are.
///
/// Source: [smap] 5.3 (table 5.2), E.1.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>

namespace hypermap {

/// Means over positions; none of none.
struct PositionErrorSummary {
  std::size_t n = 0;
  /// Of true minus mapped, each axis by itself: opposite errors cancel. Unit: metre.
  std::optional<Eigen::Vector3d> mean_m = std::nullopt;
  std::optional<double> mean_distance_m = std::nullopt;
  /// Standard deviation of the distances, over n - 1; none of fewer than two.
  std::optional<double> std_distance_m = std::nullopt;
  /// Root of the mean square, by axis: RMSE_x, RMSE_y, RMSE_z.
  std::optional<Eigen::Vector3d> rmse_m = std::nullopt;
  std::optional<double> total_rmse_m = std::nullopt;  ///< The same of the distances.
};

/// `errors_m`: true minus mapped position.
///
/// Source: [smap] table 5.2. Erratum: the table's RMSE_x, RMSE_y and RMSE_z are sums of squares,
/// neither divided nor with their root taken, and its totals divide by one object more than was
/// found.
[[nodiscard]] PositionErrorSummary summarised(std::span<const Eigen::Vector3d> errors_m);

}  // namespace hypermap
