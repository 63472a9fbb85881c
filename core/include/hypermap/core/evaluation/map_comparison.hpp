// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of two maps of a place is nearer to its truth.
///
/// Source: [hypermap] 5.2.1, table 4.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/wilcoxon.hpp"

namespace hypermap {

/// One-sided tests over the truths whose class occurs in both maps.
struct MapComparison {
  WilcoxonResult jaccard;   ///< That the first map's footprints are better.
  WilcoxonResult distance;  ///< That the first map's centroids are nearer.
};

/// Compares two maps by their evaluations against the same truth.
///
/// Errors: kInvalidArgument when the reports are not of the same truths.
[[nodiscard]] Result<MapComparison> compare(const EvaluationReport& first,
                                            const EvaluationReport& second);

}  // namespace hypermap
