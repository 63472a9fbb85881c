// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One frame of a run is put into the map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "mapping_run.hpp"
#include "refined_frames.hpp"

#include <cstddef>

namespace hypermap {

/// Maps the frame at position `index` of the input, and notes in the run and the report what is
/// known of a mapped frame: its place, hash and stamp, its views, the time of reading it.
/// Errors: that of `posed`; those of SemanticMapper::integrate and BestViews::add.
[[nodiscard]] Result<FrameReport> map_frame(MappingRun& run,
                                            std::size_t index,
                                            Result<PosedFrame> posed,
                                            const MappingJob& job,
                                            MappingReport& report);

}  // namespace hypermap
