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

/// How far a mask is from its object, in whole pixels.
struct MaskShift {
  int du_px = 0;
  int dv_px = 0;
};

/// The same as segmentation networks give it: moved, in blocks of 4 x 4 pixels that are in when
/// half of their pixels are, since networks make masks at a quarter of their input's resolution,
/// and cut off at the detection's box. Pixels from outside the image are not the object's. Source:
/// docs/EVALUATION.md, "Noise".
[[nodiscard]] MaskImage network_mask(const Image<ObjectId>& instances,
                                     ObjectId id,
                                     const PixelBox& box_px,
                                     MaskShift shift);

}  // namespace hypermap
