// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `merge` prints.
#pragma once

#include "hypermap/io/jobs/merge_job.hpp"

#include <filesystem>

namespace hypermap::app {

/// A row for each map in the order in which they were added, where maps were registered, and what
/// the merged one has.
void print_merge(const MergeReport& report, const std::filesystem::path& output);
/// The same as one JSON document.
void print_merge_json(const MergeReport& report, const std::filesystem::path& output);

}  // namespace hypermap::app
