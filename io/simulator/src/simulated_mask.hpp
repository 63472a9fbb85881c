// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Masks as detectors give them with their boxes.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/segmentation/detection.hpp"

namespace hypermap {

/// The pixels of an object.
[[nodiscard]] MaskImage exact_mask(const Image<ObjectId>& instances, ObjectId id);

/// What a network's mask is like, in whole pixels of the image.
struct MaskError {
  int block_px = 1;  ///< Edge of the squares that it consists of. Range: >= 1
  int du_px = 0;     ///< How far it is from its object.
  int dv_px = 0;
};

/// The same as segmentation networks give it: moved, in blocks that are in when half of their
/// pixels are, since networks make masks at a lower resolution, and cut off at the detection's box.
/// Pixels from outside the image are not the object's. Source: docs/EVALUATION.md, "Noise".
[[nodiscard]] MaskImage network_mask(const Image<ObjectId>& instances,
                                     ObjectId id,
                                     const PixelBox& box_px,
                                     const MaskError& error);

}  // namespace hypermap
