// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What of a mapping job is wrong before its first frame.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

namespace hypermap {

/// What would be refused at the end is refused now. Errors: kInvalidArgument for options that do
/// not go together or are out of range; those of check_target for the output and its checkpoint.
[[nodiscard]] Result<void> check_job(const MappingJob& job);

}  // namespace hypermap
