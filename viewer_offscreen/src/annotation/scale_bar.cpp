// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <cassert>
#include <cmath>

namespace hypermap {
namespace {

/// The number as a multiple of a unit, free of the noise of the division.
std::string in_units(double length_m, double unit_m, const char* unit) {
  return number_text(std::round(length_m / unit_m * 1e6) / 1e6) + " " + unit;
}

}  // namespace

double round_length_m(double max_length_m) {
  assert(std::isfinite(max_length_m) && max_length_m > 0.0);
  constexpr double kTolerance = 1.0 + 1e-9;  // 0.2 found as 0.19999999999999998 is 0.2
  const double exponent = std::floor(std::log10(max_length_m * kTolerance));
  // Powers below one by division: 1 / 10 is the double nearest to 0.1, 10^-1 need not be.
  const auto scaled = [exponent](double digit) {
    return exponent < 0.0 ? digit / std::pow(10.0, -exponent) : digit * std::pow(10.0, exponent);
  };
  for (const double digit : {5.0, 2.0}) {
    if (scaled(digit) <= max_length_m * kTolerance) return scaled(digit);
  }
  return scaled(1.0);
}

std::string length_text(double length_m) {
  if (length_m >= 1000.0) return in_units(length_m, 1000.0, "km");
  if (length_m >= 1.0) return in_units(length_m, 1.0, "m");
  if (length_m >= 0.01) return in_units(length_m, 0.01, "cm");
  return in_units(length_m, 0.001, "mm");
}

}  // namespace hypermap
