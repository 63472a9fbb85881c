// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The area that an object covers, without what the map knows not to be of it.
#pragma once

#include "column_evidence.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"
#include "hypermap/core/geometry/polygon.hpp"

namespace hypermap {

/// The part of the convex hull of an object's agreed points that those points fill, and where more
/// of it can stand: one polygon without holes.
///
/// Ours. A hull spans from the object to each stray point, over the seat of the next chair and both
/// sides of a screen's foot. Gaps up to 0.2 m between points are filled, since they are samples of
/// surfaces; specks far below the object's size go; of what is hidden or measured without an owner
/// only pieces wider than 0.1 m stay. Points fewer than the object's observations agree on help
/// where most of them are so (a surface seen at a flat angle).
/// Requires: `columns` are those of the object's box.
/// Errors: kNotFound when there are no points, as OccupancyVotes::footprint.
/// Boundary: the hull itself beyond 10^6 pixels of half a cell, and where the points are too far
/// apart to make one piece. Cost: O(pixels of half a cell of the hull's rectangle).
[[nodiscard]] Result<Polygon> carved_footprint(const OccupancyVotes& points,
                                               const ObjectColumns& columns);

}  // namespace hypermap
