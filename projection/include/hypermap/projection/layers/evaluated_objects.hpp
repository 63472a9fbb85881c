// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of an archive an evaluation compares.
#pragma once

#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <vector>

namespace hypermap {

/// Objects of a semantic layer as evaluations take them: of a truth made here with its excluded
/// objects marked and what its extra keys say, or of a map labelled by hand (nothing excluded, size
/// from the footprint). Extra keys that do not say what they should are passed over.
///
/// A shape of several parts stands for its convex hull.
[[nodiscard]] std::vector<EvaluatedObject> evaluated_objects(const SemanticLayer& layer);

}  // namespace hypermap
