// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells of a detection's surfaces belong to other detections of the frame.
#pragma once

#include "segmentation/depth_components.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// The kinds of cells with a surface that fills our box and another detection's shared out between
/// the two: the other's cells are kOthersKind. A refrigerator beside an oven is one surface, and so
/// are two chairs that touch.
///
/// A cell in both boxes is the inner one's where one box lies in the other. Else, where what each
/// box has alone tells that one thing stands before the other (see depth_orders), it belongs to the
/// thing whose depth is nearer to its own; without that to the box whose middle it is nearer to, in
/// half sides of the box. Planes of the background stay.
/// Boundary: a window without competing boxes, or of a mask, has its kinds as given.
[[nodiscard]] std::vector<std::uint8_t> shared_out(const DepthWindow& window,
                                                   const DepthComponents& labelled,
                                                   std::vector<std::uint8_t> kind_of_cell);

}  // namespace hypermap
