// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/picture_file.hpp"

#include "bmp_image.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "jpeg_image.hpp"
#include "pgm_header.hpp"
#include "picture_limits.hpp"
#include "png_chunks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

using Signature = std::pair<std::string_view, const char*>;

constexpr std::array<std::pair<std::string_view, PictureFormat>, 5> kRead = {{
    {"\x89PNG", PictureFormat::kPng},
    {"P2", PictureFormat::kPgm},
    {"P5", PictureFormat::kPgm},
    {"\xFF\xD8\xFF", PictureFormat::kJpeg},
    {"BM", PictureFormat::kBmp},
}};
constexpr std::string_view kJpeg2000File{"\0\0\0\x0CjP  ", 8};
constexpr std::array<Signature, 20> kKnownButNotRead = {{
    {"P1", "a bitmap (P1)"},
    {"P3", "a colour map (P3)"},
    {"P4", "a bitmap (P4)"},
    {"P6", "a colour map (P6)"},
    {"P7", "a PAM picture"},
    {"GIF8", "a GIF"},
    {"II*", "a TIFF"},
    {"II+", "a TIFF"},
    {"MM", "a TIFF"},
    {"RIFF", "a WebP or other RIFF file"},
    {"8BPS", "a PSD"},
    {"#?RADIANCE", "a Radiance HDR"},
    {"#?RGBE", "a Radiance HDR"},
    {"\x53\x80\xF6\x34", "a Softimage PIC"},
    {"\x76\x2F\x31\x01", "an OpenEXR"},
    {"\xFF\x4F\xFF\x51", "a JPEG 2000"},
    {kJpeg2000File, "a JPEG 2000"},
    {"PF", "a float map (PF)"},
    {"Pf", "a float map (Pf)"},
    {"\xFF\x0A", "a JPEG XL"},
}};

/// What ends a TGA of version 2; one of version 1 has no mark.
constexpr std::string_view kTgaEnd{"TRUEVISION-XFILE.\0", 18};

const char* name_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::kPng:
      return "PNG";
    case PictureFormat::kPgm:
      return "PGM";
    case PictureFormat::kJpeg:
      return "JPEG";
    case PictureFormat::kBmp:
      return "BMP";
  }
  return "picture";
}

/// What the name's extension promises; none for an extension that promises nothing.
std::optional<PictureFormat> promised_format(const SourceName& source) {
  const std::filesystem::path path = source.entry.empty() ? source.file : source.entry;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  if (extension == ".png") return PictureFormat::kPng;
  if (extension == ".pgm") return PictureFormat::kPgm;
  if (extension == ".jpg" || extension == ".jpeg") return PictureFormat::kJpeg;
  if (extension == ".bmp") return PictureFormat::kBmp;
  return std::nullopt;
}

/// The name of a format that is not read; none for bytes that are no picture at all.
std::optional<std::string> unread_format(std::string_view bytes) {
  for (const auto& [signature, name] : kKnownButNotRead) {
    if (bytes.starts_with(signature)) return name;
  }
  if (bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp") return "a HEIF, AVIF or other ISO file";
  if (bytes.ends_with(kTgaEnd)) return "a TGA";
  return std::nullopt;
}

Result<PictureFormat> format_of(std::string_view bytes, const SourceName& source) {
  const auto found = std::find_if(kRead.begin(), kRead.end(), [&](const auto& signature) {
    return bytes.starts_with(signature.first);
  });
  if (found == kRead.end()) {
    if (const auto name = unread_format(bytes)) {
      return fail(
          ErrorCode::kUnsupported, "is " + *name + ", expected PNG, PGM, JPEG or BMP", "format");
    }
    return fail(ErrorCode::kMalformedFile,
                bytes.empty() ? "is empty, expected a picture"
                              : "is no picture, expected PNG, PGM, JPEG or BMP",
                "format");
  }
  const auto promised = promised_format(source);
  if (promised && *promised != found->second) {
    return fail(ErrorCode::kMalformedFile,
                std::string("holds a ") + name_of(found->second) + ", its name promises a " +
                    name_of(*promised),
                "format");
  }
  return found->second;
}

/// Not judged against any limit.
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
  return fail(ErrorCode::kUnsupported, "picture format");
}

Result<Picture> decode(std::string_view bytes,
                       const SourceName& source,
                       const PictureLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const PictureFormat format, format_of(bytes, source));
  switch (format) {
    case PictureFormat::kPng:
      return decode_png(bytes, source, limits);
    case PictureFormat::kPgm:
      return decode_pgm(bytes, source, limits);
    case PictureFormat::kJpeg:
      return decode_jpeg(bytes, limits);
    case PictureFormat::kBmp:
      return decode_bmp(bytes, limits);
  }
  return fail(ErrorCode::kUnsupported, "picture format");
}

std::uint8_t as8(const Picture& picture, std::size_t sample) {
  if (picture.bits == 8) return picture.samples8[sample];
  return static_cast<std::uint8_t>(picture.samples16[sample] >> 8U);
}

Unexpected wrong_kind(const Picture& picture, int bits) {
  return fail(ErrorCode::kMalformedFile,
              "has " + std::to_string(picture.channels) + " channels of " +
                  std::to_string(picture.bits) + " bit, expected 1 of " + std::to_string(bits),
              "pixels");
}

template <class Sample>
Image<Sample> to_image(const Picture& picture, std::span<const Sample> samples) {
  Image<Sample> image(picture.width_px, picture.height_px);
  std::copy(samples.begin(), samples.end(), image.pixels().begin());
  return image;
}

}  // namespace

Result<void> check_size(std::int64_t width_px,
                        std::int64_t height_px,
                        const PictureLimits& limits) {
  const std::string size = std::to_string(width_px) + " x " + std::to_string(height_px);
  if (width_px <= 0 || height_px <= 0) {
    return fail(ErrorCode::kMalformedFile, "is " + size + ", expected at least 1 x 1", "size");
  }
  if (width_px > limits.max_side_px || height_px > limits.max_side_px) {
    return fail(ErrorCode::kLimit,
                "is " + size + ", the limit for a side is " + std::to_string(limits.max_side_px),
                "size");
  }
  if (static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) >
      limits.max_pixels) {
    return fail(ErrorCode::kLimit,
                "is " + size + ", the limit is " + std::to_string(limits.max_pixels) + " pixels",
                "size");
  }
  return {};
}

Error out_of_memory() {
  return {.code = ErrorCode::kOutOfMemory, .what = "no memory for the pixels"};
}

Result<PictureHeader> read_picture_header(std::string_view bytes,
                                          const SourceName& source,
                                          const PictureLimits& limits) {
  const auto read = [&]() -> Result<PictureHeader> {
    HYPERMAP_ASSIGN_OR_RETURN(const PictureFormat format, format_of(bytes, source));
    HYPERMAP_ASSIGN_OR_RETURN(PictureHeader header, read_header(bytes, format));
    HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
    return header;
  };
  auto header = read();
  if (!header) return tl::make_unexpected(with_source(header.error(), source));
  return header;
}

Result<Picture> decode_picture(std::string_view bytes,
                               const SourceName& source,
                               const PictureLimits& limits) {
  auto picture = decode(bytes, source, limits);
  if (!picture) return tl::make_unexpected(with_source(picture.error(), source));
  return picture;
}

Result<Picture> read_picture(const std::filesystem::path& path, const PictureLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, limits.max_file_bytes));
  return decode_picture(bytes, {.file = path.string()}, limits);
}

ColorImage to_color(const Picture& picture) {
  ColorImage image(picture.width_px, picture.height_px);
  const auto channels = static_cast<std::size_t>(picture.channels);
  const bool is_gray = picture.channels < 3;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const std::size_t at = i * channels;
    image.pixels()[i] = {.r = as8(picture, at),
                         .g = as8(picture, is_gray ? at : at + 1),
                         .b = as8(picture, is_gray ? at : at + 2)};
  }
  return image;
}

Result<Image<std::uint16_t>> to_gray16(const Picture& picture) {
  if (picture.channels != 1 || picture.bits != 16) return wrong_kind(picture, 16);
  return to_image<std::uint16_t>(picture, picture.samples16);
}

Result<Image<std::uint8_t>> to_gray8(const Picture& picture) {
  if (picture.channels != 1 || picture.bits != 8) return wrong_kind(picture, 8);
  return to_image<std::uint8_t>(picture, picture.samples8);
}

}  // namespace hypermap
