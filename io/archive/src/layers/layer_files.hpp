// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A layer's files: the strict form as the first implementation names and writes them, layers of
/// other classes as extensions.
#pragma once

#include "archive_members.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/projection/layers/layer_registry.hpp"

#include <string>
#include <vector>

namespace hypermap {

/// The member of a layer, or what the names of its members begin with.
[[nodiscard]] std::string stem_of(const LayerInfo& info);
/// The member that `image:` names: beside its metadata.
[[nodiscard]] std::string image_member(const std::string& metadata_member,
                                       const std::string& image);

/// An occupancy grid from `<stem>.yaml` and the image that it names; `owner` is how errors call
/// whoever names the stem ("layers[0].file").
[[nodiscard]] Result<Loaded<OccupancyLayer>> read_occupancy(ArchiveMembers& members,
                                                            const std::string& stem,
                                                            const std::string& owner,
                                                            const ArchiveLimits& limits);
/// The same in the strict form: `<stem>.yaml`, `<stem>.png`.
[[nodiscard]] Result<std::vector<OpaqueFile>> write_occupancy(const OccupancyLayer& layer,
                                                              const std::string& stem);

/// The content of the layer that `layers[index]` tells of, by the loader of its class in `types`.
[[nodiscard]] Result<Loaded<LayerContent>> read_layer(ArchiveMembers& members,
                                                      const LayerEntry& entry,
                                                      std::size_t index,
                                                      const ArchiveLimits& limits,
                                                      const LayerRegistry& types);
/// The layer that an extension holds. Requires: its format is a class of `types`.
[[nodiscard]] Result<Loaded<Layer>> read_extension_layer(ArchiveMembers& members,
                                                         const ExtensionEntry& entry,
                                                         const std::string& owner,
                                                         const ArchiveLimits& limits,
                                                         const LayerRegistry& types);

/// The members of a layer. Errors: those of MapLayer::save, naming the layer; kInvalidArgument when
/// a layer that is not to be loaded has content.
[[nodiscard]] Result<std::vector<OpaqueFile>> write_layer(const Layer& layer);
/// How the configuration lists a layer that is not of the strict form.
[[nodiscard]] ExtensionEntry extension_of(const Layer& layer);

}  // namespace hypermap
