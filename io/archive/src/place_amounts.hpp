// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How many objects of each class a part of a map has.
#pragma once

#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstdint>
#include <span>

namespace hypermap {

/// Of shapes of the layer `semantic`: with all that is believed of them where the map has their
/// objects, else by their names; classes as the map's vocabulary means them.
/// Requires: ids of that layer.
[[nodiscard]] ClassAmounts amounts_of(const MapArchive& archive,
                                      std::span<const std::uint64_t> shape_ids);

}  // namespace hypermap
