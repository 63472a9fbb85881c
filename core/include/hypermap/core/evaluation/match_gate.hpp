// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far an object of the map may be from a true one and still be it.
///
/// Source: docs/EVALUATION.md, "Matching".
#pragma once

#include "hypermap/core/evaluation/map_evaluation.hpp"

namespace hypermap {

/// Largest side; of an object whose size is not known, that of its footprint. Unit: metre.
[[nodiscard]] inline double size_of(const EvaluatedObject& object) {
  if (object.size_m > 0.0) return object.size_m;
  const Rect box = bounds(object.footprint);
  return (box.max - box.min).maxCoeff();
}

/// Objects whose centroid is farther from the truth's do not match it.
[[nodiscard]] inline double match_gate_m(const EvaluatedObject& truth,
                                         const EvaluationOptions& options) {
  return size_of(truth) < options.small_size_m ? options.small_gate_m : options.gate_m;
}

}  // namespace hypermap
