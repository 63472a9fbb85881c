// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/image_file.hpp"

#include "bmp_image.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/pgm_image.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "image_limits.hpp"
#include "jpeg_image.hpp"
#include "pgm_header.hpp"
#include "png_chunks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

using Signature = std::pair<std::string_view, const char*>;

constexpr std::array<std::pair<std::string_view, ImageFormat>, 5> kRead = {{
    {"\x89PNG", ImageFormat::kPng},
    {"P2", ImageFormat::kPgm},
    {"P5", ImageFormat::kPgm},
    {"\xFF\xD8\xFF", ImageFormat::kJpeg},
    {"BM", ImageFormat::kBmp},
}};
constexpr std::string_view kJpeg2000File{"\0\0\0\x0CjP  ", 8};
constexpr std::array<Signature, 20> kKnownButNotRead = {{
    {"P1", "a bitmap (P1)"},
    {"P3", "a colour map (P3)"},
    {"P4", "a bitmap (P4)"},
    {"P6", "a colour map (P6)"},
    {"P7", "a PAM image"},
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

/// What ends a TGA of version 2; one of version 1 has no mark, only its name tells.
constexpr std::string_view kTgaEnd{"TRUEVISION-XFILE.\0", 18};

const char* name_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::kPng:
      return "PNG";
    case ImageFormat::kPgm:
      return "PGM";
    case ImageFormat::kJpeg:
      return "JPEG";
    case ImageFormat::kBmp:
      return "BMP";
  }
  return "image";
}

/// In lower case, with its dot.
std::string extension_of(const SourceName& source) {
  const std::filesystem::path path = source.entry.empty() ? source.file : source.entry;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

/// What the name's extension promises; none for an extension that promises nothing.
std::optional<ImageFormat> format_by_extension(const SourceName& source) {
  const std::string extension = extension_of(source);
  if (extension == ".png") return ImageFormat::kPng;
  if (extension == ".pgm") return ImageFormat::kPgm;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::kJpeg;
  if (extension == ".bmp") return ImageFormat::kBmp;
  return std::nullopt;
}

/// The name of a format that is not read; none for bytes that are no image at all.
std::optional<std::string> unread_format(std::string_view bytes, const SourceName& source) {
  for (const auto& [signature, name] : kKnownButNotRead) {
    if (bytes.starts_with(signature)) return name;
  }
  if (bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp") return "a HEIF, AVIF or other ISO file";
  if (bytes.ends_with(kTgaEnd)) return "a TGA";
  if (!bytes.empty() && extension_of(source) == ".tga") return "a TGA, by its name";
  return std::nullopt;
}

Result<ImageFormat> format_of(std::string_view bytes, const SourceName& source) {
  const auto found = std::find_if(kRead.begin(), kRead.end(), [&](const auto& signature) {
    return bytes.starts_with(signature.first);
  });
  if (found == kRead.end()) {
    if (const auto name = unread_format(bytes, source)) {
      return fail(
          ErrorCode::kUnsupported, "is " + *name + ", expected PNG, PGM, JPEG or BMP", "format");
    }
    return fail(ErrorCode::kMalformedFile,
                bytes.empty() ? "is empty, expected an image"
                              : "is no image, expected PNG, PGM, JPEG or BMP",
                "format");
  }
  const auto expected = format_by_extension(source);
  if (expected && *expected != found->second) {
    return fail(ErrorCode::kMalformedFile,
                std::string("holds a ") + name_of(found->second) + ", its name promises a " +
                    name_of(*expected),
                "format");
  }
  return found->second;
}

/// Not judged against any limit.
Result<ImageHeader> read_header(std::string_view bytes, ImageFormat format) {
  switch (format) {
    case ImageFormat::kPng: {
      HYPERMAP_ASSIGN_OR_RETURN(const PngHeader header, read_png_header(bytes));
      return to_image_header(header);
    }
    case ImageFormat::kPgm: {
      HYPERMAP_ASSIGN_OR_RETURN(const PgmHeader header, read_pgm_header(bytes));
      return ImageHeader{.format = ImageFormat::kPgm,
                         .width_px = header.width_px,
                         .height_px = header.height_px,
                         .bits = header.max_value > 255 ? 16 : 8};
    }
    case ImageFormat::kJpeg:
      return read_jpeg_header(bytes);
    case ImageFormat::kBmp:
      return read_bmp_header(bytes);
  }
  return fail(ErrorCode::kUnsupported, "image format");
}

Result<DecodedImage> decode(std::string_view bytes,
                            const SourceName& source,
                            const ImageLimits& limits,
                            const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const ImageFormat format, format_of(bytes, source));
  HYPERMAP_ASSIGN_OR_RETURN(const ImageHeader header, read_header(bytes, format));
  HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
  HYPERMAP_TRY(budget.draw_pixels(header.num_pixels()));
  switch (format) {
    case ImageFormat::kPng:
      return decode_png(bytes, source, limits, budget);
    case ImageFormat::kPgm:
      return decode_pgm(bytes, source, limits);
    case ImageFormat::kJpeg:
      return decode_jpeg(bytes, limits);
    case ImageFormat::kBmp:
      return decode_bmp(bytes, limits);
  }
  return fail(ErrorCode::kUnsupported, "image format");
}

std::uint8_t as8(const DecodedImage& decoded, std::size_t sample) {
  if (decoded.bits == 8) return decoded.samples8[sample];
  return static_cast<std::uint8_t>(decoded.samples16[sample] >> 8U);
}

Unexpected wrong_kind(const DecodedImage& decoded, int bits) {
  return fail(ErrorCode::kMalformedFile,
              "has " + std::to_string(decoded.channels) + " channels of " +
                  std::to_string(decoded.bits) + " bit, expected 1 of " + std::to_string(bits),
              "pixels");
}

template <class Sample>
Image<Sample> to_image(const DecodedImage& decoded, std::span<const Sample> samples) {
  Image<Sample> image(decoded.width_px, decoded.height_px);
  std::copy(samples.begin(), samples.end(), image.pixels().begin());
  return image;
}

}  // namespace

Result<void> check_size(std::int64_t width_px, std::int64_t height_px, const ImageLimits& limits) {
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

Result<ImageHeader> read_image_header(std::string_view bytes,
                                      const SourceName& source,
                                      const ImageLimits& limits) {
  const auto read = [&]() -> Result<ImageHeader> {
    HYPERMAP_ASSIGN_OR_RETURN(const ImageFormat format, format_of(bytes, source));
    HYPERMAP_ASSIGN_OR_RETURN(ImageHeader header, read_header(bytes, format));
    HYPERMAP_TRY(check_size(header.width_px, header.height_px, limits));
    return header;
  };
  auto header = read();
  if (!header) return tl::make_unexpected(with_source(header.error(), source));
  return header;
}

Result<DecodedImage> decode_image(std::string_view bytes,
                                  const SourceName& source,
                                  const ImageLimits& limits,
                                  const LoadBudget& budget) {
  auto decoded = decode(bytes, source, limits, budget);
  if (!decoded) return tl::make_unexpected(with_source(decoded.error(), source));
  return decoded;
}

Result<DecodedImage> read_image_file(const std::filesystem::path& path, const ImageLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, limits.max_file_bytes));
  return decode_image(bytes, {.file = path.string()}, limits);
}

ColorImage to_color(const DecodedImage& decoded) {
  ColorImage image(decoded.width_px, decoded.height_px);
  const auto channels = static_cast<std::size_t>(decoded.channels);
  const bool is_gray = decoded.channels < 3;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const std::size_t at = i * channels;
    image.pixels()[i] = {.r = as8(decoded, at),
                         .g = as8(decoded, is_gray ? at : at + 1),
                         .b = as8(decoded, is_gray ? at : at + 2)};
  }
  return image;
}

Result<Image<std::uint16_t>> to_gray16(const DecodedImage& decoded) {
  if (decoded.channels != 1 || decoded.bits != 16) return wrong_kind(decoded, 16);
  return to_image<std::uint16_t>(decoded, decoded.samples16);
}

Result<Image<std::uint8_t>> to_gray8(const DecodedImage& decoded) {
  if (decoded.channels != 1 || decoded.bits != 8) return wrong_kind(decoded, 8);
  return to_image<std::uint8_t>(decoded, decoded.samples8);
}

}  // namespace hypermap
