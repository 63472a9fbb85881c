// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `map` says on stderr besides results, errors and findings.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

namespace hypermap::app {

/// What takes longer than a camera's next frame does, and what becomes of an older checkpoint.
void print_hints_before(const MappingJob& job);

/// How a run goes on that the system or the user ended, when it left a checkpoint.
void print_hint_at_resuming(const Error& error, const MappingJob& job);

/// What a map without objects may lack.
void print_hints_after(const MappingReport& report, const MappingJob& job);

}  // namespace hypermap::app
