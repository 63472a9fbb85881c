// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What changed between two maps, as text and as JSON.
#pragma once

#include "hypermap/io/archive/archive_changes.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <filesystem>
#include <span>

namespace hypermap::app {

/// A line for each object, those that stayed only with `with_same`, and how many there are of each
/// kind. Requires: `found` is of these maps.
void print_changes(const MapArchive& before,
                   const MapArchive& after,
                   const ArchiveChanges& found,
                   bool with_same);

/// All of it, and the files that were written, as one document.
void print_changes_json(const MapArchive& before,
                        const MapArchive& after,
                        const ArchiveChanges& found,
                        std::span<const std::filesystem::path> files);

}  // namespace hypermap::app
