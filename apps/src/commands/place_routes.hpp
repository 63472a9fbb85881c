// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query --route` says.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_places.hpp"
#include "place_json.hpp"

#include <string>

namespace hypermap::app {

/// To standard output: the way through doorways from one end to the other, and, where the map has a
/// topological map that joins them, that along its edges. `ends`: "FROM,TO".
/// Errors: kInvalidArgument for ends that are not that; kNotFound naming the flag.
[[nodiscard]] Result<void> print_route(const MapArchive& archive,
                                       const AskedPlaces& places,
                                       const MetreCosts& metre_costs,
                                       const std::string& ends,
                                       bool json);

}  // namespace hypermap::app
