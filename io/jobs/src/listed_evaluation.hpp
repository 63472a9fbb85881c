// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A loaded map against a list of what stands in its sequence.
#pragma once

#include "evaluated_archive.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

namespace hypermap {

/// What run_listed_evaluation does once both are loaded: `map` is that at `job.map`, `listed` that
/// at `job.truth`. Errors: those of run_listed_evaluation, but for those of loading.
/// Requires: validate(job.options).
[[nodiscard]] Result<ListedEvaluation> evaluate_listed(const EvaluatedArchive& map,
                                                       const ListedInstances& listed,
                                                       const ListedEvaluationJob& job);

}  // namespace hypermap
