// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rule behind `is_gone`, for whoever has the run of a log already.
#pragma once

#include "hypermap/core/objects/observation_log.hpp"

namespace hypermap {

/// Whether an object whose log ends in this run is gone.
[[nodiscard]] bool is_gone_by(const AbsenceRun& run, const GoneRule& rule);

}  // namespace hypermap
