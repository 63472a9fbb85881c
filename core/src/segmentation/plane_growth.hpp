// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Background planes that go on where the sensor bends them.
#pragma once

#include "background_planes.hpp"
#include "depth_window.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// Which plane each cell is of, as `plane_of_cells` numbers them, when the planes that the object
/// rises from go on: through cells of no plane that lie within twice the plane's tolerance,
/// run along it, and join its cells without a step.
///
/// Depth of structured light is wrong by centimetres over decimetres, so that a part of the floor
/// rises out of the plane that the rest of it lies on; what stands on a plane rises from it at an
/// edge. As in the detection of edges, a strict threshold says where a plane is and a loose one
/// where it goes on (hysteresis). Deviation: in none of the sources.
/// `is_object` is 1 on the object's cells, as the strict planes leave them.
/// Boundary: planes from which the object hardly rises, as a book from its table, stay as they are.
/// Cost: O(cells) for each plane that the object is near.
[[nodiscard]] std::vector<std::uint8_t> grown_planes(const DepthWindow& window,
                                                     const std::vector<Plane>& planes,
                                                     std::vector<std::uint8_t> plane_of_cell,
                                                     const std::vector<std::uint8_t>& is_object,
                                                     const ForegroundOptions& options);

}  // namespace hypermap
