// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a mapping job was asked for besides the options of the map, so that a run goes on from a
/// checkpoint only as it began.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <vector>

namespace hypermap {

/// A map of texts: which frames of which files, by which detector, aligned how. Files that the job
/// names are told by name and content. Not in it: where the input lies, and what changes no map
/// (threads, limits, checkpoints, `max_skipped_share`, `strict`, `force`).
///
/// Errors: kIo for a file that cannot be read. Cost: reads each file that the job names.
[[nodiscard]] Result<ValueTree> asked_settings(const MappingJob& job);

/// These, and the frames of the dataset by their names. Errors: those of asked_settings.
[[nodiscard]] Result<ValueTree> settings_of(const MappingJob& job, const DatasetReader& dataset);

/// What a map is made with besides options and frames, each by name and content, as options of its
/// provenance: `combiner` and `places`, those that there are.
/// Errors: kIo for a file that cannot be read.
[[nodiscard]] Result<std::vector<ValueTree::Entry>> companion_settings(const MappingJob& job);

/// Errors: kInvalidArgument naming the first setting in which the two differ, and both values.
[[nodiscard]] Result<void> refuse_other_settings(const ValueTree& now, const ValueTree& before);

}  // namespace hypermap
