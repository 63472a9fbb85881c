// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Relations of a map against those of a truth.
#pragma once

#include "evaluated_archive.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/relation_evaluation.hpp"

#include <optional>

namespace hypermap {

/// Over the pairs of objects that `report` matched. What stands on what is what the scene says
/// (`stands_on`) where it says it; all else is what the rules say of the matched objects' true
/// surfaces. None when the truth has no surfaces, or when the layer of the map shows no objects of
/// it.
[[nodiscard]] std::optional<RelationEvaluation> evaluated_relations(const EvaluatedArchive& map,
                                                                    const EvaluatedArchive& truth,
                                                                    const EvaluationReport& report);

}  // namespace hypermap
