// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far a long job has come, and whether it shall go on.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <functional>

namespace hypermap {

/// Called after each frame, one call at a time, from any thread. False ends the job with
/// kInterrupted; it then writes nothing.
using JobProgress = std::function<bool(std::size_t done, std::size_t total)>;

/// What such a job returns.
[[nodiscard]] inline Unexpected interrupted() {
  return fail(ErrorCode::kInterrupted, "interrupted, nothing was written");
}

}  // namespace hypermap
