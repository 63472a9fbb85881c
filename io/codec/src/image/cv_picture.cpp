// SPDX-License-Identifier: BSD-3-Clause
#include "cv_picture.hpp"

#include "pgm_header.hpp"
#include "picture_limits.hpp"
#include "png_chunks.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>
#include <exception>
#include <new>

namespace hypermap {
namespace {

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

Unexpected malformed_picture(std::string what, std::string field) {
  return fail(ErrorCode::kMalformedFile, std::move(what), std::move(field));
}

/// The markers of a frame's start: C0 to CF without the tables C4, C8, CC.
bool is_frame_start(unsigned marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Source: ITU-T T.81, annex B: segments until the frame header.
Result<PictureHeader> read_jpeg_header(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byte_at(bytes, at) == 0xFF) {
    const unsigned marker = byte_at(bytes, at + 1);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = (byte_at(bytes, at + 2) << 8U) | byte_at(bytes, at + 3);
    if (is_frame_start(marker)) {
      if (length < 8 || at + 10 > bytes.size()) break;
      if (byte_at(bytes, at + 4) != 8) {
        return fail(ErrorCode::kUnsupported, "JPEG of more than 8 bit", "bits");
      }
      return PictureHeader{
          .format = PictureFormat::kJpeg,
          .width_px = static_cast<int>((byte_at(bytes, at + 7) << 8U) | byte_at(bytes, at + 8)),
          .height_px = static_cast<int>((byte_at(bytes, at + 5) << 8U) | byte_at(bytes, at + 6)),
          .channels = byte_at(bytes, at + 9) == 1 ? 1 : 3};
    }
    if (length < 2) break;
    at += 2 + length;
  }
  return malformed_picture("the JPEG has no frame header", "header");
}

std::int64_t little_endian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= byte_at(bytes, at + i) << (8U * i);
  return count == 4 ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value);
}

/// A BMP's raster must be there whole: OpenCV leaves missing rows as they are.
Result<PictureHeader> read_bmp_header(std::string_view bytes) {
  if (bytes.size() < 54) return malformed_picture("the BMP header is cut", "header");
  const std::int64_t width = little_endian(bytes, 18, 4);
  const std::int64_t height = std::llabs(little_endian(bytes, 22, 4));
  const std::int64_t bits = little_endian(bytes, 28, 2);
  const std::int64_t compression = little_endian(bytes, 30, 4);
  if (width <= 0 || width > 0x7FFFFFF || height <= 0 || height > 0x7FFFFFF) {
    return malformed_picture("a side is absurd", "size");
  }
  if (compression != 0 || (bits != 8 && bits != 24 && bits != 32)) {
    return fail(ErrorCode::kUnsupported, "BMP of this compression or depth", "bits");
  }
  const std::int64_t row_bytes = (width * bits + 31) / 32 * 4;
  const std::int64_t raster = little_endian(bytes, 10, 4);
  if (raster < 54 || raster + row_bytes * height > static_cast<std::int64_t>(bytes.size())) {
    return malformed_picture("ends early", "raster");
  }
  return PictureHeader{.format = PictureFormat::kBmp,
                       .width_px = static_cast<int>(width),
                       .height_px = static_cast<int>(height),
                       .channels = 3};
}

/// libjpeg fills what is missing with grey; a file without its end mark is cut.
bool is_cut_jpeg(std::string_view bytes) {
  while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == '\n')) bytes.remove_suffix(1);
  return !bytes.ends_with("\xFF\xD9");
}

Picture from_mat(const cv::Mat& mat) {
  Picture picture{.width_px = mat.cols, .height_px = mat.rows, .channels = mat.channels()};
  cv::Mat ordered = mat;
  if (mat.channels() == 3) cv::cvtColor(mat, ordered, cv::COLOR_BGR2RGB);
  picture.samples8.reserve(ordered.total() * ordered.elemSize());
  for (int row = 0; row < ordered.rows; ++row) {
    const auto* first = ordered.ptr<std::uint8_t>(row);
    picture.samples8.insert(picture.samples8.end(),
                            first,
                            first + ordered.elemSize() * static_cast<std::size_t>(ordered.cols));
  }
  return picture;
}

}  // namespace

Result<PictureHeader> read_header(std::string_view bytes, PictureFormat format) {
  switch (format) {
    case PictureFormat::kPng: {
      HYPERMAP_ASSIGN_OR_RETURN(const PngHeader header, read_png_header(bytes));
      return to_picture_header(header);
    }
    case PictureFormat::kPgm: {
      HYPERMAP_ASSIGN_OR_RETURN(const PgmHeader header, read_pgm_header(bytes));
      return PictureHeader{.format = PictureFormat::kPgm,
                           .width_px = header.width_px,
                           .height_px = header.height_px,
                           .bits = header.max_value > 255 ? 16 : 8};
    }
    case PictureFormat::kJpeg:
      return read_jpeg_header(bytes);
    case PictureFormat::kBmp:
      return read_bmp_header(bytes);
  }
  return malformed_picture("unknown picture format", "format");
}

Result<Picture> decode_with_opencv(std::string_view bytes,
                                   PictureFormat format,
                                   const PictureLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const PictureHeader header, read_header(bytes, format));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  if (format == PictureFormat::kJpeg && is_cut_jpeg(bytes))
    return malformed_picture("ends early", "raster");
  if (bytes.size() > 0x7FFFFFFF) return fail(ErrorCode::kLimit, "has more than 2 GiB", "size");
  try {
    const cv::Mat input(1,
                        static_cast<int>(bytes.size()),
                        CV_8UC1,
                        const_cast<char*>(bytes.data()));  // NOLINT: imdecode only reads
    const cv::Mat mat =
        cv::imdecode(input,
                     header.channels == 1 ? cv::IMREAD_GRAYSCALE
                                          : cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (mat.cols != header.width_px || mat.rows != header.height_px) {
      return malformed_picture("cannot be decoded to its declared size", "raster");
    }
    return from_mat(mat);
  } catch (const std::bad_alloc&) {
    return tl::make_unexpected(out_of_memory());
  } catch (const std::exception& exception) {
    return malformed_picture(std::string("cannot be decoded: ") + exception.what(), "raster");
  }
}

}  // namespace hypermap
