// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How precisely an observation log keeps what an observation did to a belief.
#pragma once

#include <cmath>

namespace hypermap {

/// As a float of few digits: archives keep it for many frames of many objects.
[[nodiscard]] inline float in_thousandths(double value) {
  return static_cast<float>(std::round(1000.0 * value) / 1000.0);
}

}  // namespace hypermap
