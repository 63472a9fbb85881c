// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `map` says of a map that it made.
#pragma once

#include "hypermap/io/jobs/mapping_job.hpp"

namespace hypermap::app {

/// To standard output, for people. `job` is what was asked for.
void print_mapping_report(const MappingReport& report, const MappingJob& job);

}  // namespace hypermap::app
