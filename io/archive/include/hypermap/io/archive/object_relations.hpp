// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What stands on, in, under and beside what in a map.
#pragma once

#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <string>

namespace hypermap {

/// `find_relations` of the confirmed objects; gaps in voxels of the octree unless the options say
/// another voxel. Requires: validate(options).
/// Cost: as find_relations; nothing of it is stored, so a map never bears relations of an older
/// one.
[[nodiscard]] RelationGraph archive_relations(const MapArchive& archive,
                                              RelationOptions options = {});

/// How people call an object of the archive: its best class and its id, "cup 12".
/// Requires: `id` is one of its objects.
[[nodiscard]] std::string called(const MapArchive& archive, ObjectId id);

}  // namespace hypermap
