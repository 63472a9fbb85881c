// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Maps of different types and tools, saved apart, as one archive.
///
/// Source: [hypermap] requirement F1, 3.3.5 (loading of maps and configurations).
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

/// One file that becomes a part of the archive, found by its content: a map of map_server, a list
/// of named polygons or an octree of OctoMap becomes a layer; an archive or a bare configuration
/// brings all of its layers.
struct ImportedFile {
  std::filesystem::path path;
  /// Of its layer; of an archive, put before the names of its layers as `NAME_`. Empty: the file's
  /// name without its extension; an archive's layers keep their names.
  std::string name = {};
  /// In which it lies; of an archive the one that its frame `map` becomes.
  std::string frame_id = "map";
};

struct ImportJob {
  std::vector<ImportedFile> files;
  /// How the frames lie to each other, beside what archives say of theirs.
  std::vector<FrameTransform> transforms = {};
  MapDialect dialect = MapDialect::kMapServer;  ///< Of maps of map_server.
  ArchiveLimits limits = {};  ///< Of each archive; their sums of all other files together, too.
  StopCheck stop = {};
};

/// The archive, in memory: nothing is written. Layers of the archive with objects or voxels come
/// first, then those of all files in their order. Each file leaves its name, its hash and the
/// layers that it became among the provenance (is_import), before the runs that it tells of; of a
/// bare configuration the hash is that of all files that it names, too. Boundary: an archive that
/// is the only file, without name and frame, stays what it is; a file that tells of `kMaxRuns`
/// leaves these alone.
///
/// Findings: those of reading, and what an archive has that only one can bring: its vocabulary,
/// where another one's is there already, and members that nobody knows; a frame that a file was
/// given and that nothing connects with those of the others.
/// Errors: those of find_file_kind and of the readers; kUnsupported for a file that is no part of a
/// map, a labelled octree without its archive, a checkpoint, and for a second archive with objects
/// or voxels of its own, each naming the file; kInvalidArgument for two layers of one name, a name
/// that is none, frames that are connected twice, no files; kLimit.
[[nodiscard]] Result<Loaded<MapArchive>> run_import(const ImportJob& job);

}  // namespace hypermap
