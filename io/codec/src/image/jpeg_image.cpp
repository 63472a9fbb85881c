// SPDX-License-Identifier: BSD-3-Clause
#include "jpeg_image.hpp"

#include "image_limits.hpp"
#include "jpeg_decompression.hpp"

#include <cstddef>
#include <new>
#include <string>
#include <utility>

namespace hypermap {
namespace {

unsigned jpeg_byte(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

int jpeg_number(std::string_view bytes, std::size_t at) {
  return static_cast<int>((jpeg_byte(bytes, at) << 8U) | jpeg_byte(bytes, at + 1));
}

Unexpected malformed_jpeg(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

/// The markers of a frame's start: C0 to CF without the tables C4, C8, CC.
bool is_frame_start(unsigned marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// libjpeg fills what is missing with grey; a file without its end mark is cut.
bool is_cut(std::string_view bytes) {
  while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == '\n')) bytes.remove_suffix(1);
  return !bytes.ends_with("\xFF\xD9");
}

Result<DecodedImage> decode_rows(std::string_view bytes, const ImageHeader& header) {
  JpegDecompression jpeg;
  HYPERMAP_TRY(jpeg.read_header(bytes));
  if (jpeg.width_px() != header.width_px || jpeg.height_px() != header.height_px) {
    return malformed_jpeg("frame headers contradict each other", "size");
  }
  DecodedImage image{
      .width_px = header.width_px, .height_px = header.height_px, .channels = jpeg.channels()};
  image.samples8.resize(image.num_pixels() * static_cast<std::size_t>(image.channels));
  HYPERMAP_TRY(jpeg.read_rows(image.samples8));
  return image;
}

}  // namespace

Result<ImageHeader> read_jpeg_header(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && jpeg_byte(bytes, at) == 0xFF) {
    const unsigned marker = jpeg_byte(bytes, at + 1);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const int length = jpeg_number(bytes, at + 2);
    if (is_frame_start(marker)) {
      if (length < 8 || at + 10 > bytes.size()) break;
      if (jpeg_byte(bytes, at + 4) != 8) {
        return fail(ErrorCode::kUnsupported, "JPEG of more than 8 bit", "bits");
      }
      return ImageHeader{.format = ImageFormat::kJpeg,
                         .width_px = jpeg_number(bytes, at + 7),
                         .height_px = jpeg_number(bytes, at + 5),
                         .channels = jpeg_byte(bytes, at + 9) == 1 ? 1 : 3};
    }
    if (length < 2) break;
    at += 2 + static_cast<std::size_t>(length);
  }
  return malformed_jpeg("the JPEG has no frame header", "header");
}

Result<DecodedImage> decode_jpeg(std::string_view bytes, const ImageLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const ImageHeader header, read_jpeg_header(bytes));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  if (is_cut(bytes)) return malformed_jpeg("ends early", "raster");
  try {
    return decode_rows(bytes, header);
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(out_of_memory());
  }
}

}  // namespace hypermap
