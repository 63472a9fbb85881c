// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// JPEG of 8 bit: the frame header by itself, and the pixels by libjpeg-turbo.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <string_view>

namespace hypermap {

/// Size and channels of the first frame header; not judged against any limit.
/// Source: ITU-T T.81, annex B.
/// Errors: kMalformedFile when there is none; kUnsupported for more than 8 bit.
[[nodiscard]] Result<ImageHeader> read_jpeg_header(std::string_view bytes);

/// Grey or RGB in the order of the stored rows: intrinsics belong to these, so an EXIF orientation
/// is not applied.
/// Errors: kMalformedFile when the end mark or coded pixels are missing; kLimit; kOutOfMemory.
[[nodiscard]] Result<DecodedImage> decode_jpeg(std::string_view bytes, const ImageLimits& limits);

}  // namespace hypermap
