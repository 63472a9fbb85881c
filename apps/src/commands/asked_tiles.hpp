// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of a map that a question needs, of an archive or of a set of tiles.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "load_arguments.hpp"

#include <optional>
#include <string>

namespace hypermap::app {

/// Where a query's answers can lie, in frame `map`; none where only all of the map tells.
[[nodiscard]] std::optional<Rect> asked_region(const MapQuery& query);

/// Reads an archive, or, of the folder of a set of tiles or its index, the tiles that `region`
/// reaches. Errors: those of load_archive and load_archive_parts, read_tile_set and load_tiles.
[[nodiscard]] Result<PartialMap> load_asked(const std::string& file,
                                            const std::optional<Rect>& region,
                                            const ArchiveParts& parts,
                                            const LoadArguments& load);

}  // namespace hypermap::app
