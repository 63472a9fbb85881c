// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Under which name and file an extension stands in the configuration.
#pragma once

#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hypermap {

/// Name and file of a new archive's extension. Requires: a format that a map has once.
[[nodiscard]] ExtensionEntry new_entry(std::string_view format);
/// Name and stem of the i-th class grid of a new archive.
[[nodiscard]] std::string plain_grid_name(std::size_t i);

/// The extension as it was loaded, else as a new one.
[[nodiscard]] ExtensionEntry entry_of(const MapArchive& archive, std::string_view format);
/// Remembers an entry that is not as a new one would be.
void keep_entry(MapArchive& archive, ExtensionEntry entry);

}  // namespace hypermap
