// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which names of a map a text asks for, by the map's own vocabulary (asked_names.hpp).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/name_selection.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Every name by which something in the map can be asked for: its classes, the shapes and grids of
/// its layers, what cells and vertices answer. Each once, ascending. Cost: n log n in the shapes.
[[nodiscard]] std::vector<std::string> names_in(const MapArchive& archive);

/// `asked_names` among these by `archive.vocabulary`. Errors: its own.
[[nodiscard]] Result<NameSelection> asked_of_map(const MapArchive& archive, std::string_view text);

/// Whether the map has a class that the text asks for; false where the text asks for nothing.
[[nodiscard]] bool is_class_of_map(const MapArchive& archive, std::string_view text);

/// All that the texts ask for. Errors: as asked_of_map.
[[nodiscard]] Result<NameSelection> asked_of_map(const MapArchive& archive,
                                                 std::span<const std::string> texts);

/// `asked_classes` of the map's classes, by its vocabulary. Errors: its own.
[[nodiscard]] Result<std::vector<ClassId>> asked_classes(const MapArchive& archive,
                                                         std::span<const std::string> texts);

}  // namespace hypermap
