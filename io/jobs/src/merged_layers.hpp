// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What of a map is neither voxels nor objects, in another map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <string>
#include <vector>

namespace hypermap {

/// Gives `map` the layers of `added` that are not derived from voxels and objects, its octrees of
/// other programs, its frames and its vocabulary. A layer whose name another one has goes by
/// `<name>_<layer>`, and not at all when it is the same.
///
/// Returns what is renamed or left out. Errors: kInvalidArgument when that name is taken, too, or
/// frames are connected otherwise.
[[nodiscard]] Result<std::vector<Finding>> add_layers(MapArchive& map,
                                                      MapArchive added,
                                                      const std::string& name);

}  // namespace hypermap
