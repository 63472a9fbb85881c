// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/codec/value_limits.hpp"
#include "png_chunks.hpp"

#include <zlib.h>

#include <new>
#include <string>

namespace hypermap {
namespace {

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 32; shift > 0; shift -= 8) {
    bytes.push_back(static_cast<char>((value >> (shift - 8)) & 0xFFU));
  }
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view content) {
  append_big_endian(bytes, static_cast<std::uint32_t>(content.size()));
  const std::size_t start = bytes.size();
  bytes.append(type);
  bytes.append(content);
  const auto* checked = reinterpret_cast<const unsigned char*>(bytes.data() + start);
  append_big_endian(bytes, static_cast<std::uint32_t>(crc32_z(0, checked, bytes.size() - start)));
}

std::string header_chunk(int width_px, int height_px, int bits, PngColor color) {
  std::string content;
  append_big_endian(content, static_cast<std::uint32_t>(width_px));
  append_big_endian(content, static_cast<std::uint32_t>(height_px));
  content.push_back(static_cast<char>(bits));
  content.push_back(static_cast<char>(color));
  content.append(3, '\0');  // deflate, adaptive filters, not interlaced
  return content;
}

void append_pixel(std::string& row, GrayAlpha8 pixel) {
  row.push_back(static_cast<char>(pixel.gray));
  row.push_back(static_cast<char>(pixel.alpha));
}
void append_pixel(std::string& row, Rgb8 pixel) {
  row.push_back(static_cast<char>(pixel.r));
  row.push_back(static_cast<char>(pixel.g));
  row.push_back(static_cast<char>(pixel.b));
}
void append_pixel(std::string& row, std::uint8_t pixel) {
  row.push_back(static_cast<char>(pixel));
}
void append_pixel(std::string& row, std::uint16_t pixel) {
  row.push_back(static_cast<char>(pixel >> 8U));
  row.push_back(static_cast<char>(pixel & 0xFFU));
}

/// Deflate of rows that are handed in one by one.
class Compressor {
 public:
  explicit Compressor(PngEffort effort) {
    const int level = effort == PngEffort::kSmall ? Z_BEST_COMPRESSION : Z_BEST_SPEED;
    if (deflateInit(&stream_, level) != Z_OK) throw std::bad_alloc();
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  Compressor(Compressor&&) = delete;
  Compressor& operator=(Compressor&&) = delete;
  ~Compressor() { deflateEnd(&stream_); }

  void add(std::string& row) { run(row, Z_NO_FLUSH); }
  [[nodiscard]] std::string finish() {
    std::string nothing;
    run(nothing, Z_FINISH);
    return std::move(compressed_);
  }

 private:
  void run(std::string& input, int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(input.data());
    stream_.avail_in = static_cast<uInt>(input.size());
    do {
      std::string portion(std::size_t{1} << 15U, '\0');
      stream_.next_out = reinterpret_cast<Bytef*>(portion.data());
      stream_.avail_out = static_cast<uInt>(portion.size());
      deflate(&stream_, flush);
      compressed_.append(portion, 0, portion.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_{};
  std::string compressed_;
};

/// Each row is the difference to the one above (filter 2): maps and depth repeat from row to row.
template <class Pixel>
std::string compressed_rows(const Image<Pixel>& image, PngEffort effort) {
  Compressor compressor(effort);
  std::string above;
  for (int v = 0; v < image.height_px(); ++v) {
    std::string row;
    for (int u = 0; u < image.width_px(); ++u) append_pixel(row, image.at(u, v));
    std::string filtered(1, static_cast<char>(v == 0 ? 0 : 2));
    for (std::size_t i = 0; i < row.size(); ++i) {
      filtered.push_back(static_cast<char>(v == 0 ? row[i] : row[i] - above[i]));
    }
    compressor.add(filtered);
    above = std::move(row);
  }
  return compressor.finish();
}

template <class Pixel>
Result<std::string> encode(const Image<Pixel>& image, int bits, PngColor color, PngEffort effort) {
  if (image.empty()) return fail(ErrorCode::kInvalidArgument, "an empty image has no PNG", "image");
  if (image.width_px() > kMaxImageSidePx || image.height_px() > kMaxImageSidePx) {
    return fail(ErrorCode::kLimit, "a side is over 65535 pixels", "image");
  }
  try {
    const std::string pixels = compressed_rows(image, effort);
    if (pixels.size() > 0x7FFFFFFF) return fail(ErrorCode::kLimit, "has over 2 GiB", "image");
    std::string bytes(kPngSignature);
    append_chunk(bytes, "IHDR", header_chunk(image.width_px(), image.height_px(), bits, color));
    append_chunk(bytes, "IDAT", pixels);
    append_chunk(bytes, "IEND", "");
    return bytes;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the image", "image");
  }
}

}  // namespace

Result<std::string> encode_png(const Image<GrayAlpha8>& image, PngEffort effort) {
  return encode(image, 8, PngColor::kGrayAlpha, effort);
}
Result<std::string> encode_png(const ColorImage& image, PngEffort effort) {
  return encode(image, 8, PngColor::kRgb, effort);
}
Result<std::string> encode_png(const Image<std::uint8_t>& image, PngEffort effort) {
  return encode(image, 8, PngColor::kGray, effort);
}
Result<std::string> encode_png(const Image<std::uint16_t>& image, PngEffort effort) {
  return encode(image, 16, PngColor::kGray, effort);
}

}  // namespace hypermap
