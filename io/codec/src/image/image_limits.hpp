// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The size of an image, checked before memory is allocated.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/image_file.hpp"

#include <cstdint>

namespace hypermap {

/// Errors: kMalformedFile when a side is 0 or negative; kLimit, named.
[[nodiscard]] Result<void> check_size(std::int64_t width_px,
                                      std::int64_t height_px,
                                      const ImageLimits& limits);

[[nodiscard]] Error out_of_memory();

}  // namespace hypermap
