// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Distances from a boundary as probabilities.
#pragma once

#include <span>

namespace hypermap {

/// log-odds = slope * distance + offset.
struct Sigmoid {
  double slope = 0.0;
  double offset = 0.0;
};

/// The sigmoid of the greatest likelihood, the targets drawn in from 0 and 1 by as much as one
/// example would: (n+ + 1) / (n+ + 2) and 1 / (n- + 2).
///
/// Source: Platt 1999, solved by Newton's method with halved steps, as H.-T. Lin et al., "A note on
/// Platt's probabilistic outputs for support vector machines", 2007.
/// Requires: equal lengths, examples of both kinds.
[[nodiscard]] Sigmoid fit_sigmoid(std::span<const double> distances,
                                  std::span<const bool> are_positive);

}  // namespace hypermap
