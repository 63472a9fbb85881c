// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The program `hypermap-ranks`: this one, linked with MPI.
#pragma once

#include "hypermap/core/base/result.hpp"

namespace hypermap::app {

/// Runs `hypermap-ranks`, which lies beside this program, in its place, with the same words.
/// Returns only an error: kUnavailable when it is not there (built without MPI) or cannot be run.
[[nodiscard]] Result<void> become_rank();

}  // namespace hypermap::app
