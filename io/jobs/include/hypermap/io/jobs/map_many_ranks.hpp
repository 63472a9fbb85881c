// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Many sequences as one map by several machines.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/map_many_job.hpp"
#include "hypermap/io/jobs/rank_crew.hpp"

#include <optional>

namespace hypermap {

/// run_map_many by all ranks, each of which calls this with the same job: on rank 0 what became of
/// it, on the others none once rank 0 has ended. The bytes are those of one rank.
///
/// Errors, on rank 0 alone: those of run_map_many and RankCrew, and `job`'s own; one of another
/// rank names it.
[[nodiscard]] Result<std::optional<MapManyReport>> run_map_many_by_ranks(
    const Result<MapManyJob>& job, MessagePort& port, const JobProgress& progress = {});

}  // namespace hypermap
