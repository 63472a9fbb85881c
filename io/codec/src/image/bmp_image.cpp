// SPDX-License-Identifier: BSD-3-Clause
#include "bmp_image.hpp"

#include "image_limits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kFileHeaderBytes = 14;
constexpr std::size_t kSmallestHeaderBytes = 54;  // with BITMAPINFOHEADER
constexpr std::int64_t kBitFields = 3;            // BI_BITFIELDS

struct BmpLayout {
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
  bool is_top_down = false;
  std::size_t pixel_bytes = 1;
  std::array<std::size_t, 3> rgb_bytes{2, 1, 0};  ///< Where in a pixel its colours stand.
  std::size_t row_bytes = 0;                      ///< Padded to four.
  std::string_view palette = {};                  ///< Blue, green, red, unused; 8 bit only.
  std::string_view raster = {};
};

std::uint32_t little_endian32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8U * i);
  }
  return value;
}

Unexpected malformed_bmp(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

Unexpected unsupported_bmp(std::string what, std::string field) {
  return fail(ErrorCode::kUnsupported, std::move(what), std::move(field));
}

/// Which byte of a pixel a mask selects; none unless it is exactly one byte.
std::optional<std::size_t> byte_of_mask(std::uint32_t mask) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (mask == std::uint32_t{0xFF} << (8U * i)) return i;
  }
  return std::nullopt;
}

/// The three masks stand behind BITMAPINFOHEADER's 40 bytes, in longer headers within them.
Result<std::array<std::size_t, 3>> read_masks(std::string_view bytes) {
  std::array<std::size_t, 3> out{};
  if (bytes.size() < kSmallestHeaderBytes + 12) return malformed_bmp("the masks are cut", "header");
  for (std::size_t c = 0; c < 3; ++c) {
    const auto byte = byte_of_mask(little_endian32(bytes, kSmallestHeaderBytes + 4 * c));
    if (!byte) return unsupported_bmp("BMP with bit fields that are no whole bytes", "masks");
    out[c] = *byte;
  }
  return out;
}

/// The colours between header and raster, no more than declared.
std::string_view palette_of(std::string_view bytes, std::size_t start, std::size_t raster) {
  const std::uint32_t declared = little_endian32(bytes, 46);
  const std::size_t most = declared == 0 ? 256 : std::min<std::size_t>(declared, 256);
  return bytes.substr(start, std::min(4 * most, (raster - start) / 4 * 4));
}

Result<BmpLayout> read_layout(std::string_view bytes) {
  if (bytes.size() < kSmallestHeaderBytes) return malformed_bmp("the BMP header is cut", "header");
  const std::size_t header_end = kFileHeaderBytes + little_endian32(bytes, 14);
  if (header_end < kSmallestHeaderBytes) return unsupported_bmp("BMP with OS/2's header", "header");
  const auto signed_height = std::int64_t{static_cast<std::int32_t>(little_endian32(bytes, 22))};
  BmpLayout layout{.width_px = static_cast<std::int32_t>(little_endian32(bytes, 18)),
                   .height_px = std::llabs(signed_height),
                   .is_top_down = signed_height < 0};
  constexpr std::int64_t kAbsurd = 0x7FFFFFF;
  if (layout.width_px <= 0 || layout.width_px > kAbsurd || layout.height_px == 0 ||
      layout.height_px > kAbsurd) {
    return malformed_bmp("a side is absurd", "size");
  }
  const std::uint32_t bits = little_endian32(bytes, 26) >> 16U;  // behind the planes, 2 bytes each
  const std::uint32_t compression = little_endian32(bytes, 30);
  const bool has_masks = compression == kBitFields && bits == 32;
  if ((compression != 0 && !has_masks) || (bits != 8 && bits != 24 && bits != 32)) {
    return unsupported_bmp("BMP of this compression or depth", "bits");
  }
  if (has_masks) {
    HYPERMAP_ASSIGN_OR_RETURN(layout.rgb_bytes, read_masks(bytes));
  }
  layout.pixel_bytes = bits / 8;
  layout.row_bytes = (static_cast<std::size_t>(layout.width_px) * bits + 31) / 32 * 4;
  const std::size_t raster = little_endian32(bytes, 10);
  const std::size_t raster_bytes = layout.row_bytes * static_cast<std::size_t>(layout.height_px);
  if (raster < header_end || raster > bytes.size() || raster_bytes > bytes.size() - raster) {
    return malformed_bmp("ends early", "raster");
  }
  layout.raster = bytes.substr(raster, raster_bytes);
  if (bits == 8) layout.palette = palette_of(bytes, header_end, raster);
  return layout;
}

ImageHeader to_header(const BmpLayout& layout) {
  return {.format = ImageFormat::kBmp,
          .width_px = static_cast<int>(layout.width_px),
          .height_px = static_cast<int>(layout.height_px),
          .channels = 3};
}

/// The four bytes of an index's colour. Errors: kMalformedFile beyond the palette.
Result<std::string_view> color_of(const BmpLayout& layout, char index) {
  const auto at = std::size_t{4} * static_cast<unsigned char>(index);
  if (at + 4 <= layout.palette.size()) return layout.palette.substr(at, 4);
  return malformed_bmp("palette index " + std::to_string(at / 4) + " of " +
                           std::to_string(layout.palette.size() / 4) + " colours",
                       "raster");
}

Result<DecodedImage> resolve(const BmpLayout& layout) {
  DecodedImage image{.width_px = static_cast<int>(layout.width_px),
                     .height_px = static_cast<int>(layout.height_px),
                     .channels = 3};
  image.samples8.resize(3 * image.num_pixels());
  const auto height = static_cast<std::size_t>(layout.height_px);
  auto out = image.samples8.begin();
  for (std::size_t v = 0; v < height; ++v) {
    const std::size_t stored_row = layout.is_top_down ? v : height - 1 - v;
    const std::string_view row = layout.raster.substr(stored_row * layout.row_bytes);
    for (std::size_t u = 0; u < static_cast<std::size_t>(layout.width_px); ++u) {
      std::string_view color = row.substr(u * layout.pixel_bytes, layout.pixel_bytes);
      if (layout.pixel_bytes == 1) {
        HYPERMAP_ASSIGN_OR_RETURN(color, color_of(layout, color.front()));
      }
      for (const std::size_t byte : layout.rgb_bytes) {
        *out++ = static_cast<std::uint8_t>(color[byte]);
      }
    }
  }
  return image;
}

}  // namespace

Result<ImageHeader> read_bmp_header(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const BmpLayout layout, read_layout(bytes));
  return to_header(layout);
}

Result<DecodedImage> decode_bmp(std::string_view bytes, const ImageLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const BmpLayout layout, read_layout(bytes));
  HYPERMAP_TRY(check_size(layout.width_px, layout.height_px, limits));
  try {
    return resolve(layout);
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(out_of_memory());
  }
}

}  // namespace hypermap
