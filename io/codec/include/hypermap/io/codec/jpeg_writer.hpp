// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Colour images as JPEG.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <string>

namespace hypermap {

/// Baseline JPEG, YCbCr with halved colour. With one libjpeg the same bytes for the same pixels.
/// Requires: sides in 1 .. 65,500, quality in 1 .. 100. Errors: kOutOfMemory; kInvalidArgument when
/// libjpeg refuses.
[[nodiscard]] Result<std::string> encode_jpeg(const ColorImage& image, int quality);

}  // namespace hypermap
