// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/depth_view.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <cmath>
#include <cstring>
#include <new>
#include <string>

namespace hypermap {
namespace {

constexpr int kMaxSidePx = 65535;

std::size_t bytes_per_pixel(const DepthView& view) {
  return view.encoding == DepthEncoding::kUint16 ? sizeof(std::uint16_t) : sizeof(float);
}

std::size_t bytes_per_row(const DepthView& view) {
  return static_cast<std::size_t>(view.width_px) * bytes_per_pixel(view);
}

std::size_t stride_of(const DepthView& view) {
  return view.row_stride_bytes == 0 ? bytes_per_row(view) : view.row_stride_bytes;
}

Result<void> check_side_of_view(int side_px, const char* field) {
  if (side_px >= 1 && side_px <= kMaxSidePx) return {};
  return fail(
      ErrorCode::kInvalidArgument, "must be in 1..65535, is " + std::to_string(side_px), field);
}

Result<void> check(const DepthView& view) {
  HYPERMAP_TRY(check_side_of_view(view.width_px, "width_px"));
  HYPERMAP_TRY(check_side_of_view(view.height_px, "height_px"));
  if (!(std::isfinite(view.units_per_m) && view.units_per_m > 0.0)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be finite and > 0, is " + number_text(view.units_per_m),
                "units_per_m");
  }
  const std::size_t row = bytes_per_row(view);
  const std::size_t stride = stride_of(view);
  if (stride < row) {
    return fail(ErrorCode::kInvalidArgument,
                "must be 0 or at least the " + std::to_string(row) + " bytes of a row, is " +
                    std::to_string(stride),
                "row_stride_bytes");
  }
  // The last row may end where its pixels end. In these steps nothing overflows.
  const auto gaps = static_cast<std::size_t>(view.height_px - 1);
  const std::size_t size = view.buffer.size();
  if (size >= row && (gaps == 0 || stride <= (size - row) / gaps)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must hold " + std::to_string(view.height_px) + " rows of " + std::to_string(stride) +
                  " bytes, has " + std::to_string(size) + " bytes",
              "buffer");
}

bool can_be_borrowed(const DepthView& view) {
  const auto address = reinterpret_cast<std::uintptr_t>(view.buffer.data());
  return view.encoding == DepthEncoding::kFloatMetres && stride_of(view) == bytes_per_row(view) &&
         address % alignof(float) == 0;
}

/// Calls `read(pixel, bytes)` for each pixel, row by row.
template <class Read>
DepthImage read_pixels(const DepthView& view, const Read& read) {
  DepthImage image(view.width_px, view.height_px);
  auto pixel = image.pixels().begin();
  const std::byte* row = view.buffer.data();
  for (int v = 0; v < view.height_px; ++v, row += v < view.height_px ? stride_of(view) : 0) {
    for (std::size_t at = 0; at < bytes_per_row(view); at += bytes_per_pixel(view)) {
      *pixel++ = read(row + at);
    }
  }
  return image;
}

}  // namespace

Result<DepthImage> depth_image(const DepthView& view) {
  HYPERMAP_TRY(check(view));
  if (can_be_borrowed(view)) {
    return DepthImage::borrowed(
        view.width_px, view.height_px, reinterpret_cast<const float*>(view.buffer.data()));
  }
  try {
    if (view.encoding == DepthEncoding::kFloatMetres) {
      return read_pixels(view, [](const std::byte* bytes) {
        float metres = 0.0F;
        std::memcpy(&metres, bytes, sizeof(metres));
        return metres;
      });
    }
    return read_pixels(view, [&view](const std::byte* bytes) {
      std::uint16_t units = 0;
      std::memcpy(&units, bytes, sizeof(units));
      return static_cast<float>(static_cast<double>(units) / view.units_per_m);
    });
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for a depth image");
  }
}

}  // namespace hypermap
