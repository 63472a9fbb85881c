// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// With which topological map a mapper begins.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/topological_map.hpp"

#include <optional>

namespace hypermap {

/// The map that was made before, or an empty one. Errors: kInvalidArgument, field "places", when
/// that has other options.
[[nodiscard]] Result<TopologicalMap> topological_map_of(std::optional<TopologicalMap> before,
                                                        const TopologicalMapOptions& options);

}  // namespace hypermap
