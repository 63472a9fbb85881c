// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What becomes of a map that could not be saved where it should be.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <filesystem>

namespace hypermap {

/// Saves the map to `rescue_path(output)`; where no file can be made there, in the working folder,
/// then in a new folder among those for temporary files. Whole, or, when the archive is refused as
/// it is or is too large for each place, octree, objects, classes and provenance alone.
///
/// Returns `error` with what was saved where, or that nothing could be. An older rescue of the same
/// output is replaced, another file in the working folder never. How it is saved `options` say, but
/// for whether it is looked at again.
[[nodiscard]] Error with_rescue(Error error,
                                const MapArchive& archive,
                                const std::filesystem::path& output,
                                const SaveOptions& options = {});

}  // namespace hypermap
