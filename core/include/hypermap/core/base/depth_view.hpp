// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Depth as a driver holds it: a foreign buffer, in its own unit and row length.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace hypermap {

enum class DepthEncoding : std::uint8_t {
  kFloatMetres,  ///< 32-bit floats, metres; what is no measurement is 0, negative or NaN.
  kUint16,       ///< 16-bit numbers of `units_per_m` to the metre; 0 is no measurement.
};

/// A depth image that somebody else owns, in the byte order of this machine.
struct DepthView {
  std::span<const std::byte> buffer;
  int width_px = 0;
  int height_px = 0;
  DepthEncoding encoding = DepthEncoding::kFloatMetres;
  /// From the start of a row to that of the next; 0: rows follow one another without a gap.
  std::size_t row_stride_bytes = 0;
  double units_per_m = 1000.0;  ///< Of kUint16: 1000 for millimetres, 5000 for TUM RGB-D.
};

/// The image in metres. Floats that lie aligned and row by row are borrowed, not copied: the
/// buffer then has to outlive the image (a copy of the image owns its pixels). All else is
/// converted or copied.
///
/// Errors: kInvalidArgument naming the field: sides outside 1 .. 65535, a stride shorter than a
/// row, `units_per_m` not finite and > 0, a buffer that ends before the last pixel; kOutOfMemory.
[[nodiscard]] Result<DepthImage> depth_image(const DepthView& view);

}  // namespace hypermap
