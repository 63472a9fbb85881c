// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A dense picture in memory, without an image library's type.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// A row-major picture. Shape: rows x columns, row 0 on top; `at(u, v)` is column u, row v.
template <class Pixel>
class Image {
 public:
  Image() = default;  ///< Empty: 0 x 0.
  /// Requires: width_px >= 0, height_px >= 0.
  Image(int width_px, int height_px, Pixel fill = {})
      : width_px_(width_px),
        height_px_(height_px),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), fill) {}

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  [[nodiscard]] bool empty() const noexcept { return pixels_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return pixels_.size(); }
  [[nodiscard]] bool contains(int u, int v) const noexcept {
    return u >= 0 && v >= 0 && u < width_px_ && v < height_px_;
  }
  /// Position of pixel (u, v) in `pixels()`.
  [[nodiscard]] std::size_t index(int u, int v) const noexcept {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) +
           static_cast<std::size_t>(u);
  }
  [[nodiscard]] const Pixel& at(int u, int v) const noexcept {
    assert(contains(u, v));
    return pixels_[index(u, v)];
  }
  [[nodiscard]] Pixel& at(int u, int v) noexcept {
    assert(contains(u, v));
    return pixels_[index(u, v)];
  }
  [[nodiscard]] std::span<const Pixel> pixels() const noexcept { return pixels_; }
  [[nodiscard]] std::span<Pixel> pixels() noexcept { return pixels_; }
  friend bool operator==(const Image&, const Image&) = default;

 private:
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<Pixel> pixels_;
};

struct Rgb8 {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend bool operator==(Rgb8, Rgb8) = default;
};

/// Metres along the optical axis. Not a measurement: 0, negative, NaN, infinite.
using DepthImage = Image<float>;
using ColorImage = Image<Rgb8>;
/// 1 where the thing is, 0 elsewhere.
using MaskImage = Image<std::uint8_t>;

}  // namespace hypermap
