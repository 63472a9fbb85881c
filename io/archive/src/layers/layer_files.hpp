// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A layer's files, as the first implementation names and writes them.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/hypermap.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// An occupancy grid from `<stem>.yaml` and the picture that it names; `owner` is how errors call
/// whoever names the stem ("layers[0].file").
[[nodiscard]] Result<Loaded<OccupancyLayer>> read_occupancy(ArchiveMembers& members,
                                                            const std::string& stem,
                                                            const std::string& owner,
                                                            const ArchiveLimits& limits);
/// The same in the strict form: `<stem>.yaml`, `<stem>.png`.
[[nodiscard]] Result<std::vector<OpaqueFile>> write_occupancy(const OccupancyLayer& layer,
                                                              const std::string& stem);

/// The content of the layer that `layers[index]` tells of.
[[nodiscard]] Result<Loaded<LayerContent>> read_layer(ArchiveMembers& members,
                                                      const LayerEntry& entry,
                                                      std::size_t index,
                                                      const ArchiveLimits& limits);
[[nodiscard]] Result<std::vector<OpaqueFile>> write_layer(const Layer& layer);

}  // namespace hypermap
