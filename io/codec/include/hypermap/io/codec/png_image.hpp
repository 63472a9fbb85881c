// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Strict PNG reading, and PNG writing that gives the same bytes for the same pixels.
///
/// Source: PNG specification, third edition (signature, chunks, CRC, IHDR, filters).
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

/// Errors: kMalformedFile for a missing or repeated signature, IHDR, PLTE (where needed), IDAT or
/// IEND, a wrong chunk length or CRC, a forbidden depth, filter or palette index, too few or too
/// many pixels, bytes after IEND; kLimit for the size; kOutOfMemory;
/// kInterrupted when `budget` is told to stop.
/// Cost: text and other ancillary chunks are checked by CRC and never inflated.
[[nodiscard]] Result<DecodedImage> decode_png(std::string_view bytes,
                                              const SourceName& source,
                                              const ImageLimits& limits = {},
                                              const LoadBudget& budget = {});

/// Grey and alpha of one pixel.
struct GrayAlpha8 {
  std::uint8_t gray = 0;
  std::uint8_t alpha = 255;
  friend bool operator==(GrayAlpha8, GrayAlpha8) = default;
};

/// What to save when writing a PNG.
enum class PngEffort {
  kSmall,  ///< Space: for what is kept, as the layers of an archive.
  kFast,   ///< Time, about a tenth: for the many images of a sequence.
};

/// A PNG file's bytes: no time stamp, no text, fixed filter and, for an effort, a fixed
/// compression level.
/// Errors: kInvalidArgument when the image is empty; kLimit when a side is over 65,535.
[[nodiscard]] Result<std::string> encode_png(const Image<GrayAlpha8>& image,
                                             PngEffort effort = PngEffort::kSmall);
[[nodiscard]] Result<std::string> encode_png(const ColorImage& image,
                                             PngEffort effort = PngEffort::kSmall);
[[nodiscard]] Result<std::string> encode_png(const Image<std::uint8_t>& image,
                                             PngEffort effort = PngEffort::kSmall);
[[nodiscard]] Result<std::string> encode_png(const Image<std::uint16_t>& image,
                                             PngEffort effort = PngEffort::kSmall);

}  // namespace hypermap
