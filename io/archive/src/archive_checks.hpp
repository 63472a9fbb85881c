// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the parts of an archive must agree in: classes and objects that others speak of exist.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <optional>

namespace hypermap {

/// The largest class id that octree and objects speak of, named or not; none when they speak of
/// none.
[[nodiscard]] std::optional<ClassId> largest_class_of(const MapArchive& archive);

/// That every class which octree and objects speak of is in the registry.
/// Errors: kMalformedFile naming the part.
[[nodiscard]] Result<void> check_classes(const MapArchive& archive);

/// That every object which a voxel names is in the map.
/// Errors: kInvalidArgument naming the object.
[[nodiscard]] Result<void> check_objects_of_voxels(const MapArchive& archive);

/// Voxels that name an object which is not in the map become voxels of none: then there is a
/// finding.
[[nodiscard]] std::optional<Finding> forget_absent_objects(MapArchive& archive);

}  // namespace hypermap
