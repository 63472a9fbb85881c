// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/depth_file.hpp"

#include "hypermap/io/codec/image_file.hpp"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

namespace hypermap {
namespace {

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

Result<void> check_size(const DecodedImage& image, ImageSize expected, const std::string& file) {
  const bool fits = (expected.width_px == 0 || image.width_px == expected.width_px) &&
                    (expected.height_px == 0 || image.height_px == expected.height_px);
  if (fits) return {};
  return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                          .what = "is " + size_text(image.width_px, image.height_px) +
                                  ", expected the camera's " +
                                  size_text(expected.width_px, expected.height_px),
                          .file = file,
                          .field = "size"});
}

Result<DecodedImage> read_sized(const std::filesystem::path& path, ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(DecodedImage image, read_image_file(path));
  HYPERMAP_TRY(check_size(image, expected, path.string()));
  return image;
}

/// Metres of each of the 65,536 values as they were before they were rotated; 0 for those that are
/// no measurement.
std::vector<float> metres_of(const DepthFormat& format) {
  std::vector<float> metres(65536);
  for (std::size_t value = 0; value < metres.size(); ++value) {
    metres[value] = static_cast<float>(static_cast<double>(value) / format.units_per_m);
  }
  for (const std::uint16_t value : format.invalid_values) metres[value] = 0.0F;
  return metres;
}

}  // namespace

Result<DepthImage> read_depth(const std::filesystem::path& path,
                              const DepthFormat& format,
                              ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, read_sized(path, expected));
  if (image.bits != 16 || image.channels != 1) {
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "has " + std::to_string(image.channels) + " channel(s) of " +
                                    std::to_string(image.bits) +
                                    " bit, expected depth: one channel of 16 bit",
                            .file = path.string(),
                            .field = "format"});
  }
  const std::vector<float> metres = metres_of(format);
  DepthImage depth(image.width_px, image.height_px);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::uint16_t value = image.samples16[i];
    depth.pixels()[i] = metres[std::rotr(value, format.rotated_left_bits)];
  }
  return depth;
}

Result<ColorImage> read_color(const std::filesystem::path& path, ImageSize expected) {
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage image, read_sized(path, expected));
  return to_color(image);
}

Result<ImageSize> read_image_size(const std::filesystem::path& path) {
  constexpr std::size_t kEnoughForJpegMetadata = std::size_t{1} << 18U;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Unexpected(
        Error{.code = ErrorCode::kIo, .what = std::strerror(errno), .file = path.string()});
  }
  std::string bytes(kEnoughForJpegMetadata, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  HYPERMAP_ASSIGN_OR_RETURN(const ImageHeader header,
                            read_image_header(bytes, SourceName{path.string()}));
  return ImageSize{header.width_px, header.height_px};
}

}  // namespace hypermap
