// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Maps of one place, by several sessions or robots, as one map.
///
/// Source: [hypermap] requirement F1. What is done with voxels, objects and the rest:
/// docs/MERGE.md.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/world_placement.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace hypermap {

/// One of the maps.
struct MergedFile {
  std::filesystem::path path;
  /// Where its origin lies in the first map, metres and radians; none: both have one origin, or
  /// what `MergeJob::registers` finds.
  std::optional<WorldPlacement> placement = std::nullopt;
};

struct MergeJob {
  std::vector<MergedFile> files;  ///< Two or more; the result lies in the frame of the first.
  /// Finds where maps without a placement lie in the first one by what both show.
  bool registers = false;
  /// The maps were made one after the other as they are given, whatever their stamps say.
  bool in_order = false;
  /// Of associating objects, of confirming them and of the layers.
  MapOptions options = {};
  ArchiveLimits limits = {};  ///< Of each archive.
  StopCheck stop = {};
};

/// How a map was placed by what it shows.
struct MapPlacement {
  WorldPlacement placement = {};
  double overlap = 0.0;         ///< Share of its known cells that both know.
  double agreement = 0.0;       ///< Correlation of what both say there, up to 1.
  double occupied_share = 0.0;  ///< Of its occupied voxels there, those that both have, within one.
};

/// What one of the maps brought, in the order in which they were added.
struct MergedMap {
  std::filesystem::path path;
  std::size_t num_sessions = 0;
  /// Whether all of its frames came after those of the maps before it: then its look is the newer.
  bool is_later = false;
  std::optional<MapPlacement> found = std::nullopt;  ///< Where it was registered.
  LeafCount leaves = {};                             ///< Of its octree.
  std::size_t num_joined = 0;                        ///< Objects that the map had already.
  std::size_t num_new = 0;                           ///< Those that it had not.
  std::size_t num_gone = 0;  ///< Objects of earlier maps whose place it saw empty.
};

struct MergeReport {
  std::vector<MergedMap> maps;
  LeafCount leaves = {};
  std::size_t num_objects = 0;    ///< Confirmed.
  std::size_t num_tentative = 0;  ///< The others.
  std::size_t num_sessions = 0;
  std::vector<Finding> findings = {};
};

struct MergeResult {
  MapArchive map;
  MergeReport report;
};

/// The merged map, in memory: nothing is written.
///
/// Maps are looked through first, without their voxels and objects, and then added one by one, by
/// the stamps of their frames, the oldest first (equal stamps by the hash of their input): so the
/// order in which they are given does not matter but for the frame, which is the first's. Never
/// more than two are held.
/// Findings: those of reading, layers that cannot be made, whatever of one map another one has
/// otherwise, options of association that a map's newest run had otherwise, and runs that may be of
/// one recording. Errors: kInvalidArgument for fewer than two files, a run that two maps have,
/// voxels of another size or model, and a pair of objects whose beliefs, histograms or points were
/// made with different options; kUnsupported for a map without an octree, a checkpoint, and for
/// frames of two names; with `registers`, those of `register_maps`; those of load_archive,
/// `transformed`, `merged` and `derive_layers`; kInterrupted. Each names the file. Threads: the
/// same bytes at any number.
[[nodiscard]] Result<MergeResult> run_merge(const MergeJob& job, const JobProgress& progress = {});

}  // namespace hypermap
