// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a run tells of its frames, summed up.
#pragma once

#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

namespace hypermap {

/// Adds what became of one given pose.
void count(const PoseCorrection& pose, PoseCounts& counts);

/// Adds a frame that is in the map.
void count(const FrameReport& frame, MappingReport& report);

}  // namespace hypermap
