// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the targets of image formats have in common.
#pragma once

#include "fuzz_target.hpp"
#include "hypermap/io/codec/image_file.hpp"

namespace hypermap::fuzz {

inline constexpr ImageLimits kImageLimits{
    .max_side_px = 4096, .max_pixels = 1U << 18U, .max_file_bytes = 1U << 20U};

/// Whether what is done with its pixels would take as long as thousands of other inputs.
[[nodiscard]] inline bool is_large_image(std::string_view bytes) {
  const auto header = read_image_header(bytes, kFuzzSource, {.max_pixels = 1U << 16U});
  return !header && header.error().code == ErrorCode::kLimit;
}

/// The image, if it is one that is read: as large as its header says, with a sample for each
/// channel of each pixel, none above the largest value.
[[nodiscard]] inline Result<DecodedImage> checked_image(std::string_view bytes) {
  const auto header = read_image_header(bytes, kFuzzSource, kImageLimits);
  auto image = decode_image(bytes, kFuzzSource, kImageLimits);
  if (!image) return image;
  require(require(header, "an image that is read has a header").width_px == image->width_px &&
              header->height_px == image->height_px,
          "an image has the size that its header says");
  const std::size_t num_samples = image->num_pixels() * static_cast<std::size_t>(image->channels);
  require((image->bits == 16 ? image->samples16.size() : image->samples8.size()) == num_samples,
          "an image has all its samples");
  for (const std::uint16_t sample : image->samples16)
    require(sample <= image->max_value, "no sample is above the largest value");
  require(to_color(*image).size() == image->num_pixels(), "every image has colours");
  return image;
}

}  // namespace hypermap::fuzz
