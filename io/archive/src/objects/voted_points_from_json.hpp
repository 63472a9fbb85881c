// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where an object's observations had points, from its JSON line.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <optional>

namespace hypermap {

/// `cells`: in a file of version 3 the line of its voted cells. Errors: those of parse_objects,
/// naming line and path.
[[nodiscard]] Result<OccupancyVotes> voted_points_from_json(const JsonNode& node,
                                                            const std::optional<JsonNode>& cells);

}  // namespace hypermap
