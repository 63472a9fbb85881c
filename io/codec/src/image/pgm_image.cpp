// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/pgm_image.hpp"

#include "image_limits.hpp"
#include "pgm_header.hpp"

#include <new>
#include <span>
#include <utility>

namespace hypermap {
namespace {

Unexpected malformed_pgm(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

/// Bytes that a raster needs at least: a digit and a blank a sample in P2.
std::size_t least_bytes(const PgmHeader& header, std::size_t num_pixels) {
  if (header.is_text) return 2 * num_pixels - 1;
  return num_pixels * (header.max_value > 255 ? 2 : 1);
}

Result<std::uint16_t> next_sample(PgmText& text, const PgmHeader& header) {
  if (!text.skip_blanks()) return malformed_pgm("a comment never ends", "raster");
  const std::string_view at = text.rest();
  if (const auto sample = text.number(header.max_value)) {
    return static_cast<std::uint16_t>(*sample);
  }
  return malformed_pgm("sample is " + printable_token(at) +
                           ", expected a number from 0 to maxval " +
                           std::to_string(header.max_value),
                       "raster");
}

template <class Sample>
Result<void> read_text(const PgmHeader& header, std::span<Sample> samples) {
  PgmText text(header.raster);
  for (Sample& sample : samples) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint16_t value, next_sample(text, header));
    sample = static_cast<Sample>(value);
  }
  if (!text.skip_blanks() || !text.rest().empty()) {
    return malformed_pgm("more follows after the last sample: " + printable_token(text.rest()),
                         "raster");
  }
  return {};
}

/// One line end after the raster is let through; some programs write it.
bool has_honest_length(std::string_view raster, std::size_t needed) {
  return raster.size() == needed || raster.substr(needed) == "\n" ||
         raster.substr(needed) == "\r\n";
}

template <class Sample>
Result<void> read_binary(const PgmHeader& header, std::span<Sample> samples) {
  constexpr bool kIsWide = sizeof(Sample) == 2;
  if (!has_honest_length(header.raster, samples.size() * (kIsWide ? 2 : 1))) {
    return malformed_pgm("bytes follow after the last sample", "raster");
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(header.raster[i]); };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const unsigned value = kIsWide ? (unsigned{byte(2 * i)} << 8U) | byte(2 * i + 1) : byte(i);
    if (value > static_cast<unsigned>(header.max_value)) {
      return malformed_pgm("sample " + std::to_string(value) + " is above maxval " +
                               std::to_string(header.max_value),
                           "raster");
    }
    samples[i] = static_cast<Sample>(value);
  }
  return {};
}

template <class Sample>
Result<std::vector<Sample>> read_raster(const PgmHeader& header, std::size_t num_pixels) {
  std::vector<Sample> samples(num_pixels);
  HYPERMAP_TRY(header.is_text ? read_text<Sample>(header, samples)
                              : read_binary<Sample>(header, samples));
  return samples;
}

Result<DecodedImage> decode_pgm(std::string_view bytes, const ImageLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const PgmHeader header, read_pgm_header(bytes));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  DecodedImage image{.width_px = header.width_px,
                     .height_px = header.height_px,
                     .bits = header.max_value > 255 ? 16 : 8,
                     .max_value = header.max_value};
  if (header.raster.size() < least_bytes(header, image.num_pixels())) {
    return malformed_pgm("ends early: " + std::to_string(header.raster.size()) + " bytes for " +
                             std::to_string(image.num_pixels()) + " samples",
                         "raster");
  }
  if (image.bits == 16) {
    HYPERMAP_ASSIGN_OR_RETURN(image.samples16,
                              read_raster<std::uint16_t>(header, image.num_pixels()));
  } else {
    HYPERMAP_ASSIGN_OR_RETURN(image.samples8,
                              read_raster<std::uint8_t>(header, image.num_pixels()));
  }
  return image;
}

}  // namespace

Result<DecodedImage> decode_pgm(std::string_view bytes,
                                const SourceName& source,
                                const ImageLimits& limits) {
  try {
    auto image = decode_pgm(bytes, limits);
    if (!image) return tl::make_unexpected(with_source(image.error(), source));
    return image;
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(with_source(out_of_memory(), source));
  }
}

Result<std::string> encode_pgm(const Image<std::uint8_t>& image) {
  if (image.empty()) return fail(ErrorCode::kInvalidArgument, "an empty image has no PGM", "image");
  std::string bytes = "P5\n" + std::to_string(image.width_px()) + " " +
                      std::to_string(image.height_px()) + "\n255\n";
  bytes.append(image.pixels().begin(), image.pixels().end());
  return bytes;
}

}  // namespace hypermap
