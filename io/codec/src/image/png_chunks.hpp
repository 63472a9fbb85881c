// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The chunks of a PNG, checked one by one before any pixel is decoded.
///
/// Source: PNG specification, third edition, sections 5 (structure), 11 (chunks).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hypermap {

inline constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1A\n", 8};

enum class PngColor : std::uint8_t { kGray = 0, kRgb = 2, kPalette = 3, kGrayAlpha = 4, kRgba = 6 };

/// IHDR. Sides are as declared, up to 2^31 - 1.
struct PngHeader {
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
  int bits = 8;  ///< Per sample: 1, 2, 4, 8, 16.
  PngColor color = PngColor::kGray;
  bool interlaced = false;
};

/// A checked file: views of the bytes that were given.
struct PngLayout {
  PngHeader header;
  std::string_view palette = {};       ///< RGB triples; empty when there is none.
  std::string_view transparency = {};  ///< tRNS; empty when there is none.
  /// The signature, then each whole chunk that the pixels depend on: IHDR, PLTE, tRNS, IDAT, IEND.
  std::vector<std::string_view> chunks = {};
  std::uint64_t compressed_bytes = 0;  ///< Of all IDAT together.
};

/// Samples per pixel as stored (a palette index counts as one).
[[nodiscard]] int stored_channels(PngColor color);
/// What IHDR alone says; a palette counts as three channels, tRNS is not looked at.
[[nodiscard]] ImageHeader to_image_header(const PngHeader& header);

/// Errors: kMalformedFile for a wrong signature or a cut, damaged or forbidden IHDR.
[[nodiscard]] Result<PngHeader> read_png_header(std::string_view bytes);

/// Errors: kMalformedFile for a chunk that is cut, has a wrong CRC, stands in a wrong place, twice
/// or not at all, for bytes after IEND; kUnsupported for a critical chunk that is not known.
[[nodiscard]] Result<PngLayout> read_png_layout(std::string_view bytes);

}  // namespace hypermap
