// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/png_image.hpp"
#include "image_limits.hpp"
#include "png_chunks.hpp"
#include "png_decompression.hpp"

#include <array>
#include <cstdint>
#include <new>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// A sub-image of an interlaced PNG; the whole is one pass of step 1.
struct Pass {
  int x0 = 0;
  int y0 = 0;
  int step_x = 1;
  int step_y = 1;
};

constexpr std::array<Pass, 1> kWhole = {{{}}};
/// Source: PNG specification, section 8.2, Adam7.
constexpr std::array<Pass, 7> kAdam7 = {{{0, 0, 8, 8},
                                         {4, 0, 8, 8},
                                         {0, 4, 4, 8},
                                         {2, 0, 4, 4},
                                         {0, 2, 2, 4},
                                         {1, 0, 2, 2},
                                         {0, 1, 1, 2}}};

std::uint64_t steps(std::int64_t size, int start, int step) {
  return size <= start ? 0 : static_cast<std::uint64_t>((size - start + step - 1) / step);
}

/// Bytes of all filtered rows, before compression.
std::uint64_t raw_bytes(const PngHeader& header) {
  const int bits_of_pixel = header.bits * stored_channels(header.color);
  const auto bits = static_cast<std::uint64_t>(bits_of_pixel);
  const auto passes = header.interlaced ? std::span<const Pass>(kAdam7) : kWhole;
  std::uint64_t total = 0;
  for (const Pass& pass : passes) {
    const std::uint64_t width = steps(header.width_px, pass.x0, pass.step_x);
    const std::uint64_t height = steps(header.height_px, pass.y0, pass.step_y);
    if (width > 0) total += height * ((bits * width + 7) / 8 + 1);
  }
  return total;
}

/// Deflate shrinks to no less than one 1,032nd; what declares more cannot be honest.
Result<void> check_declared_size(const PngLayout& layout) {
  constexpr std::uint64_t kMostInflation = 1032;
  if (raw_bytes(layout.header) <= layout.compressed_bytes * kMostInflation) return {};
  return fail(ErrorCode::kMalformedFile,
              std::to_string(layout.compressed_bytes) + " bytes cannot hold " +
                  std::to_string(layout.header.width_px) + " x " +
                  std::to_string(layout.header.height_px) + " pixels",
              "IDAT");
}

/// The colours of indices, with alpha where the layout has tRNS.
Result<DecodedImage> resolve_palette(const DecodedImage& indices, const PngLayout& layout) {
  const std::string_view palette = layout.palette;
  const std::string_view alpha = layout.transparency;
  DecodedImage out{.width_px = indices.width_px,
                   .height_px = indices.height_px,
                   .channels = alpha.empty() ? 3 : 4};
  out.samples8.reserve(out.num_pixels() * static_cast<std::size_t>(out.channels));
  for (const std::size_t index : indices.samples8) {
    if (3 * index >= palette.size()) {
      return fail(ErrorCode::kMalformedFile,
                  "palette index " + std::to_string(index) + " of " +
                      std::to_string(palette.size() / 3) + " colours",
                  "IDAT");
    }
    for (const char sample : palette.substr(3 * index, 3)) {
      out.samples8.push_back(static_cast<std::uint8_t>(sample));
    }
    if (alpha.empty()) continue;
    out.samples8.push_back(index < alpha.size() ? static_cast<std::uint8_t>(alpha[index])
                                                : std::uint8_t{255});
  }
  return out;
}

Result<DecodedImage> decode(std::string_view bytes,
                            const ImageLimits& limits,
                            const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const PngHeader header, read_png_header(bytes));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  HYPERMAP_ASSIGN_OR_RETURN(const PngLayout layout, read_png_layout(bytes));
  HYPERMAP_TRY(check_declared_size(layout));
  HYPERMAP_ASSIGN_OR_RETURN(DecodedImage samples, decompress_png(layout, budget));
  if (header.color == PngColor::kPalette) return resolve_palette(samples, layout);
  return samples;
}

}  // namespace

Result<DecodedImage> decode_png(std::string_view bytes,
                                const SourceName& source,
                                const ImageLimits& limits,
                                const LoadBudget& budget) {
  try {
    auto image = decode(bytes, limits, budget);
    if (!image) return tl::make_unexpected(with_source(image.error(), source));
    return image;
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(with_source(out_of_memory(), source));
  }
}

}  // namespace hypermap
