// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Maps and truths of either kind as the rates take them.
#pragma once

#include "evaluated_archive.hpp"
#include "hypermap/core/evaluation/run_rates.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

namespace hypermap {

/// A map against a truth that is an archive: found is what the one-to-one metric matches, and
/// fits as it says; of voxels nothing is told.
/// Requires: validate(options).
[[nodiscard]] RatedRun rated_run(const EvaluatedArchive& map,
                                 const EvaluatedArchive& truth,
                                 const EvaluationOptions& options);

/// A map against a list: found is what `evaluation` found. `evaluation` is of that map.
[[nodiscard]] RatedRun rated_run(const EvaluatedArchive& map,
                                 const ListedEvaluation& evaluation,
                                 const InstanceComparisonOptions& options);

}  // namespace hypermap
