// SPDX-License-Identifier: BSD-3-Clause
#include "png_chunks.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>

namespace hypermap {
namespace {

constexpr std::size_t kFrameBytes = 12;  // length, type and CRC around a chunk's content
constexpr std::size_t kHeaderBytes = 13;

struct Chunk {
  std::string_view type;
  std::string_view content;
  std::string_view whole;  ///< With length and CRC.
};

Unexpected malformed_chunk(std::string what, std::string_view field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::string(field));
}

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

bool is_type(std::string_view type) {
  return std::all_of(type.begin(), type.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  });
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

/// The chunk at the front, with its CRC checked.
Result<Chunk> read_chunk(std::string_view bytes) {
  if (bytes.size() < kFrameBytes) return malformed_chunk("the file ends before IEND", "chunk");
  const std::uint32_t length = big_endian(bytes, 0);
  const std::string_view type = bytes.substr(4, 4);
  if (!is_type(type)) return malformed_chunk("is no chunk type: " + printable(type), "chunk");
  if (length > 0x7FFFFFFFU || length > bytes.size() - kFrameBytes) {
    return malformed_chunk("declares " + std::to_string(length) + " bytes, " +
                               std::to_string(bytes.size() - kFrameBytes) + " are there",
                           type);
  }
  if (crc_of(bytes.substr(4, std::size_t{4} + length)) !=
      big_endian(bytes, std::size_t{8} + length)) {
    return malformed_chunk("the CRC is wrong", type);
  }
  return Chunk{type, bytes.substr(8, length), bytes.substr(0, kFrameBytes + length)};
}

bool is_allowed_depth(PngColor color, int bits) {
  switch (color) {
    case PngColor::kGray:
      return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
    case PngColor::kPalette:
      return bits == 1 || bits == 2 || bits == 4 || bits == 8;
    case PngColor::kRgb:
    case PngColor::kGrayAlpha:
    case PngColor::kRgba:
      return bits == 8 || bits == 16;
  }
  return false;
}

Result<PngHeader> parse_header(const Chunk& chunk) {
  if (chunk.type != "IHDR")
    return malformed_chunk("the first chunk is " + printable(chunk.type), "IHDR");
  if (chunk.content.size() != kHeaderBytes) {
    return malformed_chunk("has " + std::to_string(chunk.content.size()) + " bytes, expected 13",
                           "IHDR");
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(chunk.content[i]); };
  const PngHeader header{.width_px = big_endian(chunk.content, 0),
                         .height_px = big_endian(chunk.content, 4),
                         .bits = byte(8),
                         .color = static_cast<PngColor>(byte(9)),
                         .interlaced = byte(12) == 1};
  if (!is_allowed_depth(header.color, header.bits)) {
    return malformed_chunk("bit depth " + std::to_string(header.bits) + " with colour type " +
                               std::to_string(byte(9)) + " is not allowed",
                           "IHDR");
  }
  if (byte(10) != 0 || byte(11) != 0 || byte(12) > 1) {
    return malformed_chunk("compression, filter or interlace method is not known", "IHDR");
  }
  if (header.width_px > 0x7FFFFFFF || header.height_px > 0x7FFFFFFF) {
    return malformed_chunk("a side is above 2147483647", "IHDR");
  }
  return header;
}

/// Keeps what is needed of each chunk and watches their order.
class Collector {
 public:
  Collector(const PngHeader& header, std::string_view signature, std::string_view header_chunk) {
    layout_.header = header;
    layout_.chunks = {signature, header_chunk};
  }

  [[nodiscard]] Result<void> take(const Chunk& chunk) {
    const bool is_data = chunk.type == "IDAT";
    if (is_data && data_is_over_) return malformed_chunk("stands apart from the others", "IDAT");
    data_is_over_ = !is_data && has_data_;
    if (is_data) {
      has_data_ = true;
      layout_.chunks.push_back(chunk.whole);
      layout_.compressed_bytes += chunk.content.size();
      return {};
    }
    if (chunk.type == "PLTE") return take_palette(chunk);
    if (chunk.type == "tRNS") return take_transparency(chunk);
    const bool is_critical = chunk.type[0] >= 'A' && chunk.type[0] <= 'Z';
    if (chunk.type == "IHDR") return malformed_chunk("stands twice", "IHDR");
    if (is_critical)
      return fail(ErrorCode::kUnsupported, "chunk is not known", std::string(chunk.type));
    return {};
  }

  [[nodiscard]] Result<PngLayout> finish(const Chunk& end) {
    if (layout_.header.color == PngColor::kPalette && layout_.palette.empty()) {
      return malformed_chunk("is missing", "PLTE");
    }
    if (!has_data_) return malformed_chunk("is missing", "IDAT");
    layout_.chunks.push_back(end.whole);
    return std::move(layout_);
  }

 private:
  [[nodiscard]] Result<void> take_palette(const Chunk& chunk) {
    const PngColor color = layout_.header.color;
    if (color == PngColor::kGray || color == PngColor::kGrayAlpha) {
      return malformed_chunk("stands in a grey image", "PLTE");
    }
    if (!layout_.palette.empty() || has_data_ || !layout_.transparency.empty()) {
      return malformed_chunk("stands twice or too late", "PLTE");
    }
    const std::size_t most = color == PngColor::kPalette
                                 ? std::size_t{1} << static_cast<unsigned>(layout_.header.bits)
                                 : 256;
    const std::size_t size = chunk.content.size();
    if (size == 0 || size % 3 != 0 || size / 3 > most) {
      return malformed_chunk("has " + std::to_string(size) +
                                 " bytes, expected 3 for each of 1 to " + std::to_string(most) +
                                 " colours",
                             "PLTE");
    }
    layout_.palette = chunk.content;
    layout_.chunks.push_back(chunk.whole);
    return {};
  }

  [[nodiscard]] Result<void> take_transparency(const Chunk& chunk) {
    if (!layout_.transparency.empty() || has_data_) {
      return malformed_chunk("stands twice or too late", "tRNS");
    }
    const std::size_t size = chunk.content.size();
    const PngColor color = layout_.header.color;
    const bool fits =
        (color == PngColor::kGray && size == 2) || (color == PngColor::kRgb && size == 6) ||
        (color == PngColor::kPalette && size > 0 && size <= layout_.palette.size() / 3);
    if (!fits) return malformed_chunk("does not fit the colour type", "tRNS");
    layout_.transparency = chunk.content;
    layout_.chunks.push_back(chunk.whole);
    return {};
  }

  PngLayout layout_;
  bool has_data_ = false;
  bool data_is_over_ = false;
};

}  // namespace

int stored_channels(PngColor color) {
  switch (color) {
    case PngColor::kGray:
    case PngColor::kPalette:
      return 1;
    case PngColor::kGrayAlpha:
      return 2;
    case PngColor::kRgb:
      return 3;
    case PngColor::kRgba:
      return 4;
  }
  return 1;
}

ImageHeader to_image_header(const PngHeader& header) {
  const bool is_palette = header.color == PngColor::kPalette;
  return {.format = ImageFormat::kPng,
          .width_px = static_cast<int>(header.width_px),
          .height_px = static_cast<int>(header.height_px),
          .channels = is_palette ? 3 : stored_channels(header.color),
          .bits = header.bits};
}

Result<PngHeader> read_png_header(std::string_view bytes) {
  if (!bytes.starts_with(kPngSignature))
    return malformed_chunk("the PNG signature is damaged", "signature");
  HYPERMAP_ASSIGN_OR_RETURN(const Chunk first, read_chunk(bytes.substr(kPngSignature.size())));
  return parse_header(first);
}

Result<PngLayout> read_png_layout(std::string_view bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const PngHeader header, read_png_header(bytes));
  constexpr std::size_t kHeaderEnd = kPngSignature.size() + kFrameBytes + kHeaderBytes;
  Collector collector(header,
                      bytes.substr(0, kPngSignature.size()),
                      bytes.substr(kPngSignature.size(), kFrameBytes + kHeaderBytes));
  bytes.remove_prefix(kHeaderEnd);
  while (true) {
    HYPERMAP_ASSIGN_OR_RETURN(const Chunk chunk, read_chunk(bytes));
    bytes.remove_prefix(chunk.whole.size());
    if (chunk.type != "IEND") {
      HYPERMAP_TRY(collector.take(chunk));
      continue;
    }
    if (!bytes.empty())
      return malformed_chunk(std::to_string(bytes.size()) + " bytes follow", "IEND");
    return collector.finish(chunk);
  }
}

}  // namespace hypermap
