// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of an object that stand apart from the rest of it in depth.
#pragma once

#include "segmentation/depth_components.hpp"

#include <cstdint>

namespace hypermap {

/// Whether surface `id` is a part of the object whose best surface is `best` though it stands apart
/// behind it: the far legs of a table, the head of a bed, where the top between them is too flat to
/// be measured.
///
/// It is whole in the box, its edge is mostly its own outline, nothing hides its foot, and it is no
/// farther behind than two thirds of the box's width there. What merely stands behind an object and
/// looks over it has its foot hidden. Requires: both have cells in the box. Cost: O(cells of the
/// bounds of both).
[[nodiscard]] bool is_part_behind(const DepthWindow& window,
                                  const DepthComponents& labelled,
                                  std::uint32_t best,
                                  std::uint32_t id);

/// Whether surface `id` is the upper end of the object though it stands apart behind it: the head
/// of a bed behind its pillows.
///
/// The detector's box ends with it at the top, far above what is `covered`. It is wide, reaches
/// farther back than the best surface, and with it the object is no deeper than one and a half
/// times the box's width; or than 2.5 m where the best surface fills two thirds of that and a
/// metre, as the mattress of a bed that is seen from its foot. Boundary: none where the picture or
/// the window cuts it or the box, and none of a box much wider than high. Requires: both have cells
/// in the box. Cost: O(cells of the bounds of both).
[[nodiscard]] bool is_top_of_box(const DepthWindow& window,
                                 const DepthComponents& labelled,
                                 const PixelRect& covered,
                                 std::uint32_t best,
                                 std::uint32_t id);

/// Whether surface `id` is the far side of the object though it stands apart behind it: the back of
/// a sofa that is seen over its near arm by a low camera, which sees nothing of the seat.
///
/// The detector's box ends with it on the left or on the right, far beside what is `covered`. It is
/// high and wide, reaches farther back than the best surface, and with it the object is no deeper
/// than one and a half times the box's width there and 2.5 m. Boundary: none where the picture cuts
/// it or the box on that side. Requires: both have cells in the box. Cost: O(cells of the bounds of
/// both).
[[nodiscard]] bool is_side_of_box(const DepthWindow& window,
                                  const DepthComponents& labelled,
                                  const PixelRect& covered,
                                  std::uint32_t best,
                                  std::uint32_t id);

}  // namespace hypermap
