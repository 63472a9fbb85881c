// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hypermap/io/archive/archive_sizes.hpp"

#include <string>

namespace hypermap::app {

/// What `info --sizes` prints: a table of the parts, one of the objects' fields, the map as grids.
[[nodiscard]] std::string sizes_text(const ArchiveSizes& sizes);

}  // namespace hypermap::app
