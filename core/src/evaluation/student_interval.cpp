// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/student_interval.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace hypermap {

std::optional<double> student_half_width_95(double standard_deviation, std::size_t n) {
  if (n < 2 || !std::isfinite(standard_deviation) || standard_deviation < 0.0) return std::nullopt;
  constexpr double kUpperQuantile = 0.975;
  const boost::math::students_t distribution(static_cast<double>(n - 1));
  return boost::math::quantile(distribution, kUpperQuantile) * standard_deviation /
         std::sqrt(static_cast<double>(n));
}

}  // namespace hypermap
