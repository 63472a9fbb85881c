// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An image of how reliable probabilities are.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/evaluation/calibration.hpp"

namespace hypermap {

/// Two panels side by side, P(best class) left in blue, P(real) right in orange: probability from
/// left to right, share that was true from bottom to top, both 0 .. 1 with a line at each tenth;
/// a square for each bin, joined in their order, an upright line from it to the diagonal on which
/// all would lie. At the axes stand their names and 0, 0.5 and 1.
[[nodiscard]] ColorImage draw_reliability(const CalibrationReport& best_class,
                                          const CalibrationReport& real);

}  // namespace hypermap
