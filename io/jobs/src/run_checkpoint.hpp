// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far a run of a mapping job had come when it saved its map on the way: what is noted in the
/// checkpoint beside the map (MapArchive::checkpoint).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// A mapped frame of the input, so that it is known again.
struct NotedFrame {
  std::size_t position = 0;  ///< In the dataset, 0 .. size() - 1.
  std::string hash;          ///< As `frame_hash` gives it.
  friend bool operator==(const NotedFrame&, const NotedFrame&) = default;
};

struct RunCheckpoint {
  std::size_t num_positions = 0;               ///< Frames of the input that were mapped or skipped.
  NotedFrame first;                            ///< That was mapped.
  NotedFrame last;                             ///< That was mapped.
  std::vector<std::size_t> skipped_positions;  ///< Ascending.
  /// Counts, and the skipped frames in the order of `skipped_positions`; neither times nor
  /// findings.
  MappingReport report;
  ValueTree settings;  ///< What the run was asked for (run_settings.hpp).
};

[[nodiscard]] ValueTree to_tree(const RunCheckpoint& checkpoint);
/// Of a skipped frame the text of its error remains, and whether it was the system's fault (kIo).
/// Errors: kMalformedFile naming the key, for a tree that to_tree would not give.
[[nodiscard]] Result<RunCheckpoint> parse_run_checkpoint(const ValueTree& tree,
                                                         const std::string& file);

}  // namespace hypermap
