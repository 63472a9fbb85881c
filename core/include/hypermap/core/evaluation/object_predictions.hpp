// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a map says of its objects with some probability, held against the truth.
///
/// Source: docs/EVALUATION.md, "Calibration".
#pragma once

#include "hypermap/core/evaluation/calibration.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// An object with what the map believes of it; `shape.class_name` is its best class.
struct BelievedObject {
  std::uint64_t id = 0;
  EvaluatedObject shape = {};
  bool is_confirmed = false;
  double real_probability = 0.0;        ///< That it exists.
  double best_class_probability = 0.0;  ///< That it is of its best class.
};

struct ObjectPredictions {
  std::vector<Prediction> real;        ///< Of all objects.
  std::vector<Prediction> best_class;  ///< Of confirmed objects that are real and can be named.
  /// Which true object each object is; none: it is false, or a duplicate.
  std::vector<std::optional<std::size_t>> truth_of;
};

/// An object is real when it is assigned a true one, excluded ones included. Assigned at most once,
/// each time at the least sum of distances within the gate: confirmed objects to truths of their
/// class; tentative ones to those left; then confirmed and tentative ones to what is left of any
/// class, where their boxes overlap by an intersection over union of 0.1 and more.
///
/// Of objects that are real, the class is right when it is that of the truth. Truths that the
/// detector cannot name say nothing of it, nor do excluded ones of an older truth, which does not
/// tell why.
/// Requires: validate(options). Cost: O(n^3).
[[nodiscard]] ObjectPredictions object_predictions(std::span<const BelievedObject> objects,
                                                   std::span<const EvaluatedObject> truth,
                                                   const EvaluationOptions& options = {});

}  // namespace hypermap
