// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Many sequences as one map: each is mapped, then their maps are merged in pairs. What is done by
/// whom, and what is kept on the way: docs/MANY.md.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/io/jobs/sequence_list.hpp"
#include "hypermap/io/jobs/work_crew.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct MapManyJob {
  std::vector<ListedSequence> sequences = {};
  /// What all sequences share. Not looked at: what each says itself (input, output, description,
  /// detections, poses, session), and what is of one map that goes on (append, resume,
  /// checkpoints, placement). `up_axis` holds where a sequence has none.
  MappingJob mapping = {};
  std::filesystem::path output = {};  ///< The merged map, in the frame of the first sequence's.
  /// Folder of the sequences' own maps, `<name>.hmap`, and of what is on the way from these to the
  /// whole. Several jobs may share it one after the other, with names of their own.
  std::filesystem::path parts = {};
  bool keeps_parts = true;  ///< Else they go once the whole is there.
  bool force = false;       ///< Parts that stand are made anew.
  bool in_order = false;    ///< As `MergeJob::in_order`, of the sequences.
};

/// What is in a map.
struct PartCounts {
  std::uint64_t frames = 0;   ///< That were mapped.
  std::uint64_t skipped = 0;  ///< Frames that could not be used.
  std::uint64_t objects = 0;  ///< Confirmed.
  std::uint64_t tentative = 0;
  std::uint64_t sessions = 0;
  LeafCount leaves = {};
  friend bool operator==(const PartCounts&, const PartCounts&) = default;
};

/// What became of a sequence.
struct MappedSequence {
  std::string name;
  std::filesystem::path part;
  /// "kept", "made", or "made anew: " and why the part that was there did not do.
  std::string note = {};
  PartCounts counts = {};
  std::vector<std::string> findings = {};     ///< Also those of when a kept part was made.
  std::optional<Error> error = std::nullopt;  ///< It could not be mapped.
};

/// What a worker of the crew did.
struct WorkerReport {
  std::size_t num_tasks = 0;  ///< Sequences that it mapped or found mapped, and merges.
  double busy_s = 0.0;
  std::uint64_t peak_rss_bytes = 0;  ///< Of its process.
};

struct MapManyReport {
  std::vector<MappedSequence> sequences = {};  ///< In the order of the list.
  /// Of the merged map; none: it was not written, as some sequence could not be mapped.
  std::optional<PartCounts> merged = std::nullopt;
  std::size_t num_merges = 0;              ///< That were made now; others stood.
  std::vector<std::string> findings = {};  ///< Of merging and of clearing away.
  std::vector<WorkerReport> workers = {};  ///< By their numbers.
  double wall_s = 0.0;
};

/// Maps the sequences and merges their maps in pairs, in an order that the maps alone decide: the
/// bytes are the same whoever is in the crew. A worker holds two maps at most.
///
/// Goes on from what an earlier run left in `parts`: a map there is used again if its record says
/// that this program made it of the same files (by content) with the same options, and it is, byte
/// for byte, as it was made.
/// Progress counts sequences and merges. A sequence that cannot be mapped is told in the report;
/// the others are mapped, and no output is written.
/// Errors: kInvalidArgument without a sequence; those of `validate`, check_target and run_merge;
/// kIo for a folder that cannot be made; kInterrupted; those of the crew. `output` is old or new as
/// a whole, and parts stay.
[[nodiscard]] Result<MapManyReport> run_map_many(const MapManyJob& job,
                                                 WorkCrew& crew,
                                                 const JobProgress& progress = {});

}  // namespace hypermap
