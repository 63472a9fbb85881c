// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of the surfaces in a detection's box are the detected object.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "segmentation/background_planes.hpp"
#include "segmentation/depth_components.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace hypermap {

using ComponentIds = std::vector<std::uint32_t>;  ///< Positions in the components, ascending.

/// The surface that explains the box best (large in it, absent outside it, from edge to edge) and
/// the parts that complete it; a flat patch of its support when nothing stands out. Empty when
/// nothing lies in the box, or only background and other detections' objects.
/// `frame` is what the window was cut out of.
[[nodiscard]] ComponentIds choose_surfaces(const RgbdFrame& frame,
                                           const DepthWindow& window,
                                           const DepthComponents& labelled,
                                           const std::vector<Plane>& planes,
                                           const ForegroundOptions& options);

/// Calls `visit(x, y)` for each cell of a component that lies in the box, row by row.
template <class Visit>
void for_each_cell_of(const DepthWindow& window,
                      const DepthComponents& labelled,
                      std::uint32_t id,
                      Visit visit) {
  const PixelRect& bounds = labelled.components[id].bounds_in_box;
  for (int y = bounds.v_begin; y < bounds.v_end; ++y) {
    for (int x = bounds.u_begin; x < bounds.u_end; ++x) {
      if (labelled.of_cell[window.cell(x, y)] == id) visit(x, y);
    }
  }
}

}  // namespace hypermap
