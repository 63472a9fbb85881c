// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How sure the mean of a few measurements is.
#pragma once

#include <cstddef>
#include <optional>

namespace hypermap {

/// How far the 95 % confidence interval of a mean reaches to either side of it:
/// t s / sqrt(n), t the 0.975 quantile of Student's distribution with n - 1 degrees of freedom and
/// s the standard deviation (over n - 1) of the `n` values.
///
/// Source: Student, "The probable error of a mean", Biometrika 6, 1908.
/// Unit: that of `standard_deviation`.
/// Boundary: none of fewer than two values, or of a deviation that is negative or not finite. The
/// interval of a share may reach beyond 0 and 1.
[[nodiscard]] std::optional<double> student_half_width_95(double standard_deviation, std::size_t n);

}  // namespace hypermap
