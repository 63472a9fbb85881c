// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What our archives hold beyond the strict form: octree, objects, classes, class grids,
/// provenance, a run's checkpoint, layers of other classes.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "member_files.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// Reads one extension into `archive` and tells what it noticed. `owner` is how errors call it
/// ("extensions[2].file"). Errors: those of its reader; kMalformedFile for a second one of a kind
/// that a map has once.
[[nodiscard]] Result<std::vector<Finding>> read_extension(MapArchive& archive,
                                                          ArchiveMembers& members,
                                                          const ExtensionEntry& entry,
                                                          const std::string& owner,
                                                          const ArchiveLimits& limits);

struct OctreeTwin {
  ExtensionEntry entry;
  MemberFile file;
};

/// All extensions of a map in a fixed order, and their files.
struct WrittenExtensions {
  std::vector<ExtensionEntry> entries;
  std::vector<MemberFile> files;
  /// Beside those, where no file of the map has its name.
  std::optional<OctreeTwin> octree_twin = std::nullopt;
};
/// Large members are packed already, within these limits.
[[nodiscard]] Result<WrittenExtensions> write_extensions(const MapArchive& archive,
                                                         const ZipLimits& limits);

}  // namespace hypermap
