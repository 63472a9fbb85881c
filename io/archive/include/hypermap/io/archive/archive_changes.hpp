// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What changed in a place between two archives of it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/changes/map_changes.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The 2D layer of what changed.
inline constexpr std::string_view kChangesLayer = "changes";

struct ArchiveChanges {
  std::string frame_id;
  /// The later map goes on from the earlier one: its oldest runs are those of the earlier.
  bool goes_on = false;
  std::vector<ObjectChange> changes;
};

/// `find_changes` of the confirmed objects; space is what the octrees know,
/// within a voxel to each side. Classes are equal when
/// the vocabulary of the later map, or of the earlier if that has none, says so.
///
/// Where the later map goes on from the earlier one, an object that it neither saw nor missed since
/// is not looked at, and one that it removed, or saw through its place, is gone. Both maps lie in
/// one frame; `transformed` moves one that does not. Errors: kUnsupported for a map without an
/// octree or with none of our objects, and for maps whose voxels lie in frames of two names; each
/// names `before` or `after`. Requires: validate(options). Cost: as find_changes.
[[nodiscard]] Result<ArchiveChanges> archive_changes(const MapArchive& before,
                                                     const MapArchive& after,
                                                     const ChangeOptions& options = {});

/// All but what stayed as it was, as shapes: where something is now or else where it was. The name
/// is the kind and the class, "gone chair"; tags are the kind's key and the ids, "before 3", "after
/// 7"; ids count from 1. Errors: those of SemanticLayer::create.
[[nodiscard]] Result<SemanticLayer> changes_layer(const MapArchive& before,
                                                  const MapArchive& after,
                                                  const ArchiveChanges& found);

}  // namespace hypermap
