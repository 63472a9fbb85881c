// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Headers of all picture formats, and the pixels of those that OpenCV decodes.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/picture_file.hpp"

#include <string_view>

namespace hypermap {

/// Size, channels and depth as the first bytes declare them; not judged against any limit.
/// Errors: kMalformedFile when they are cut or absurd; kUnsupported for a JPEG that is not of 8
/// bit.
[[nodiscard]] Result<PictureHeader> read_header(std::string_view bytes, PictureFormat format);

/// A JPEG or BMP. The header is judged first, so OpenCV never sees a giant.
/// Errors: kMalformedFile when the bytes are cut or do not hold the declared size; kLimit.
[[nodiscard]] Result<Picture> decode_with_opencv(std::string_view bytes,
                                                 PictureFormat format,
                                                 const PictureLimits& limits);

}  // namespace hypermap
