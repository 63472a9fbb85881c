// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One-to-one assignment at least cost.
///
/// Source: H. W. Kuhn, "The Hungarian method for the assignment problem", 1955, in the form with
/// potentials and shortest augmenting paths.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace hypermap {

/// The cost of a pair that must not be made.
inline constexpr double kForbiddenPair = std::numeric_limits<double>::infinity();

/// For each row its column, or none. First as many pairs as possible, then the least sum of costs.
///
/// Shape: any, rows x columns; costs are finite or kForbiddenPair (NaN counts as that).
/// Boundary: no rows or no columns give no pairs. Of equally good assignments always the same one
/// comes out. Cost: O(n^3), n = the larger side.
[[nodiscard]] std::vector<std::optional<std::size_t>> assign(const Eigen::MatrixXd& costs);

}  // namespace hypermap
