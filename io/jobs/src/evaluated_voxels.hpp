// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voxels of a map against the true surfaces.
#pragma once

#include "evaluated_archive.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"

#include <string>

namespace hypermap {

/// Why the voxels cannot be compared; empty when they can.
[[nodiscard]] std::string why_no_voxels(const MapArchive& map, const MapArchive& truth);

/// Requires: why_no_voxels gives no reason; both are understood. Errors: those of
/// understood_voxels and evaluate_voxels.
[[nodiscard]] Result<VoxelOutcome> evaluated_voxels(const EvaluatedArchive& map,
                                                    const EvaluatedArchive& truth,
                                                    const StopCheck& stop);

}  // namespace hypermap
