// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Depth and colour pictures of a sequence as the frame types of core.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hypermap {

/// How a dataset writes depth into 16-bit pictures.
struct DepthFormat {
  double units_per_m = 1000.0;  ///< TUM: 5000; most others: 1000. Range: 1e-3 .. 1e6
  /// Values that are no measurement.
  std::vector<std::uint16_t> invalid_values = {0, 65535};
};

/// Expected size of a picture; 0: any.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(PictureSize, PictureSize) = default;
};

/// Reads a 16-bit PNG or PGM of one channel; 0 in the result is "no measurement".
///
/// Errors, all naming the file: kIo; kLimit; kMalformedFile when it is no such picture or is cut;
/// kInvalidArgument when its size is not `expected`.
[[nodiscard]] Result<DepthImage> read_depth(const std::filesystem::path& path,
                                            const DepthFormat& format,
                                            PictureSize expected = {});

/// Reads a PNG, JPEG, BMP or PGM as colour. Errors: as above.
[[nodiscard]] Result<ColorImage> read_color(const std::filesystem::path& path,
                                            PictureSize expected = {});

/// The size of a picture from its first bytes. Errors: kIo; kMalformedFile.
[[nodiscard]] Result<PictureSize> read_picture_size(const std::filesystem::path& path);

}  // namespace hypermap
