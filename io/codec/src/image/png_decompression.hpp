// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The samples of a checked PNG, by libpng.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "png_chunks.hpp"

namespace hypermap {

/// Grey and colours as samples of 8 or 16 bit, a transparent colour as alpha; a palette's indices
/// as one channel of 8 bit, whatever the palette holds.
///
/// What libpng only warns of is an error.
/// Errors: kMalformedFile when the compressed rows are damaged, too few, too many or do not end
/// with their checksum; kOutOfMemory; kInterrupted when `budget` is told to stop.
[[nodiscard]] Result<DecodedImage> decompress_png(const PngLayout& layout,
                                                  const LoadBudget& budget);

}  // namespace hypermap
