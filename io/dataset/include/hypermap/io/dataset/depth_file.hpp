// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Depth and colour images of a sequence as the frame types of core.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hypermap {

/// How a dataset writes depth into 16-bit images.
struct DepthFormat {
  double units_per_m = 1000.0;  ///< TUM: 5000; most others: 1000. Range: 1e-3 .. 1e6
  /// Values that are no measurement.
  std::vector<std::uint16_t> invalid_values = {0, 65535};
  /// By how many bits values were rotated to the left when they were written (SUN RGB-D: 3);
  /// `invalid_values` are those before. Range: 0 .. 15
  int rotated_left_bits = 0;
};

/// Expected size of an image; 0: any.
struct ImageSize {
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(ImageSize, ImageSize) = default;
};

/// Reads a 16-bit PNG or PGM of one channel; 0 in the result is "no measurement".
///
/// Errors, all naming the file: kIo; kLimit; kMalformedFile when it is no such image or is cut;
/// kInvalidArgument when its size is not `expected`.
[[nodiscard]] Result<DepthImage> read_depth(const std::filesystem::path& path,
                                            const DepthFormat& format,
                                            ImageSize expected = {});

/// Reads a PNG, JPEG, BMP or PGM as colour. Errors: as above.
[[nodiscard]] Result<ColorImage> read_color(const std::filesystem::path& path,
                                            ImageSize expected = {});

/// The size of an image from its first bytes. Errors: kIo; kMalformedFile.
[[nodiscard]] Result<ImageSize> read_image_size(const std::filesystem::path& path);

}  // namespace hypermap
