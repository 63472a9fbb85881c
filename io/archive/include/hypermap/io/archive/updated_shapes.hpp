// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Updates of a semantic layer beside the objects of a 3D map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"

#include <string_view>

namespace hypermap {

/// `Hypermap::update` of a layer of the archive. A shape of the layer `semantic` that bears an
/// object's id stands for that object, which the map shows for it; so shapes that get their ids
/// here get such as no object ever had, and those that bring one bring none of an object that the
/// layer does not show. Errors: those of Hypermap::update; kInvalidArgument for such an id. Nothing
/// changes then.
[[nodiscard]] Result<SemanticUpdateReport> update_shapes(MapArchive& archive,
                                                         std::string_view layer,
                                                         SemanticUpdate update);

}  // namespace hypermap
