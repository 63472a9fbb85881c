// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a background plane merely cuts through a surface.
#pragma once

#include "background_planes.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// `plane_of_cell` with 0 on the slices that planes cut out of other surfaces: at the height of a
/// table's top the backs of the chairs behind it are on the plane of the top, too.
///
/// Cells below each other are a slice where the surface goes on above and below them without a step
/// and on no plane, and where its depth changes from end to end otherwise than the plane's, by
/// three quarters of the larger change. The top of a table seen flat, between its front and a cup
/// behind it, is none: its depth changes as its plane's. Cost: O(cells of the window). Not in the
/// sources.
[[nodiscard]] std::vector<std::uint8_t> without_slices(const DepthWindow& window,
                                                       const std::vector<Plane>& planes,
                                                       std::vector<std::uint8_t> plane_of_cell);

}  // namespace hypermap
