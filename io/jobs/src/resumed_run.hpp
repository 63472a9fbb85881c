// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A run that goes on from its checkpoint: what it takes over, and whether it is the same run.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "mapping_run.hpp"
#include "run_checkpoint.hpp"

namespace hypermap {

/// The map as a run saved it on its way, and how far the run had come.
struct SavedRun {
  MapArchive map;  ///< With an octree and at least one run.
  RunCheckpoint checkpoint;
};

/// What lies at `checkpoint_path(job.output)`. Errors: kNotFound when nothing does; kUnsupported
/// for a map without a note of its run; those of load_archive and parse_run_checkpoint.
[[nodiscard]] Result<SavedRun> load_saved_run(const MappingJob& job);

/// Whether `run` began as the saved one did, told by its settings, the options and the alignment of
/// the map, the runs before it, and the first and last frame that the saved one mapped, which are
/// read again. Errors: kInvalidArgument naming what differs; those of reading these frames.
/// Requires: all of `run` but its mapper is open.
[[nodiscard]] Result<void> refuse_other_run(MappingRun& run,
                                            const MappingJob& job,
                                            const SavedRun& saved);

/// Gives `run` what the saved one had when it was saved, but its mapper.
void take_over(MappingRun& run, const SavedRun& saved, MappingReport& report);

}  // namespace hypermap
