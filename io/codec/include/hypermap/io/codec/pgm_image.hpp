// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Portable grey maps: P2 and P5, 8 and 16 bit.
///
/// Source: Netpbm, pgm(5): width, height and maxval are decimal; comments run from # to the line's
/// end, before the raster of P5; maxval is 1 to 65,535, above 255 two bytes a sample, high one
/// first.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

/// Errors: kMalformedFile for numbers that are none, zero or too large, a sample above maxval, too
/// few samples, bytes after them (one line end is allowed in P5, blanks and comments in P2);
/// kLimit for the size.
[[nodiscard]] Result<DecodedImage> decode_pgm(std::string_view bytes,
                                              const SourceName& source,
                                              const ImageLimits& limits = {});

/// A P5 file's bytes with maxval 255. Errors: kInvalidArgument when the image is empty.
[[nodiscard]] Result<std::string> encode_pgm(const Image<std::uint8_t>& image);

}  // namespace hypermap
