// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// BMP of 8 bit with palette, of 24 and of 32 bit, without compression.
///
/// Source: Microsoft, "Bitmap Storage": BITMAPFILEHEADER, BITMAPINFOHEADER and its longer forms.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <string_view>

namespace hypermap {

/// Errors: kMalformedFile when the header or the raster is cut or a side is absurd; kUnsupported
/// for run lengths, other depths, bit fields that are no whole bytes, headers of OS/2.
[[nodiscard]] Result<ImageHeader> read_bmp_header(std::string_view bytes);

/// RGB, the upper row first; a fourth byte of the pixels is dropped.
/// Errors: those of read_bmp_header; kMalformedFile for an index beyond the palette; kLimit;
/// kOutOfMemory.
[[nodiscard]] Result<DecodedImage> decode_bmp(std::string_view bytes, const ImageLimits& limits);

}  // namespace hypermap
