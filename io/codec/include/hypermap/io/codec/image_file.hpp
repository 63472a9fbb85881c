// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Image files from untrusted sources: PNG, PGM, JPEG and BMP, validated before memory is
/// allocated.
///
/// Scope: PNG of every colour type, depth and interlacing (png_image.hpp); PGM P2 and P5 of up
/// to 16 bit with comments (pgm_image.hpp); JPEG and BMP of 8 bit. Found by content, not by the
/// name: a file named .png must hold a PNG when its name says so (see read_image_file).
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct ImageLimits {
  int max_side_px = 65'535;
  std::size_t max_pixels = std::size_t{1} << 28U;
  std::size_t max_file_bytes = std::size_t{2} << 30U;
};

enum class ImageFormat { kPng, kPgm, kJpeg, kBmp };

/// Pixels as stored, palettes resolved to colours, bits of less than 8 scaled up to 8.
///
/// Shape: rows x columns x channels, row 0 on top. Channels: 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA.
struct DecodedImage {
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  int bits = 8;  ///< 8 or 16 per channel; says which vector holds the samples.
  std::vector<std::uint8_t> samples8 = {};
  std::vector<std::uint16_t> samples16 = {};  ///< In this machine's byte order.
  int max_value = 255;                        ///< A PGM's own; else 255 or 65,535.

  [[nodiscard]] bool has_alpha() const noexcept { return channels == 2 || channels == 4; }
  [[nodiscard]] std::size_t num_pixels() const noexcept {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
  friend bool operator==(const DecodedImage&, const DecodedImage&) = default;
};

/// What an image's first bytes say. Nothing is decoded.
struct ImageHeader {
  ImageFormat format = ImageFormat::kPng;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  int bits = 8;  ///< As stored: 1, 2, 4, 8, 16.

  /// Requires: sides that are not negative.
  [[nodiscard]] std::uint64_t num_pixels() const noexcept {
    return static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px);
  }
};

/// Errors: kMalformedFile when it is none of the formats or its header is cut or absurd; kLimit;
/// kUnsupported for a format that is known but not read (P1, P4, P6, GIF, TIFF, ...).
[[nodiscard]] Result<ImageHeader> read_image_header(std::string_view bytes,
                                                    const SourceName& source,
                                                    const ImageLimits& limits = {});

/// Errors: those of read_image_header; kMalformedFile when the content contradicts the extension
/// of the name, a checksum, or the declared size, or is cut: half an image is never returned;
/// kOutOfMemory; those of LoadBudget::draw_pixels. Cost: memory for the pixels is taken once, after
/// the header was checked against the limits and against what the compressed bytes can at most
/// hold, and the pixels were drawn from `budget`.
[[nodiscard]] Result<DecodedImage> decode_image(std::string_view bytes,
                                                const SourceName& source,
                                                const ImageLimits& limits = {},
                                                const LoadBudget& budget = {});
/// A file on disk. Errors: those of decode_image and kIo.
[[nodiscard]] Result<DecodedImage> read_image_file(const std::filesystem::path& path,
                                                   const ImageLimits& limits = {});

/// Colours of 8 bit: grey repeated, 16 bit by their high byte, alpha dropped.
[[nodiscard]] ColorImage to_color(const DecodedImage& decoded);
/// The samples of a 16-bit image of one channel. Errors: kMalformedFile for any other image.
[[nodiscard]] Result<Image<std::uint16_t>> to_gray16(const DecodedImage& decoded);
/// The samples of an 8-bit image of one channel. Errors: kMalformedFile for any other image.
[[nodiscard]] Result<Image<std::uint8_t>> to_gray8(const DecodedImage& decoded);

}  // namespace hypermap
