// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A dense image in memory, without an image library's type.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {

/// A row-major image. Shape: rows x columns, row 0 on top; `at(u, v)` is column u, row v.
///
/// Owns its pixels, or borrows those of a buffer that outlives it (`borrowed`). A value either way:
/// a copy owns its pixels, and so does a borrower once it is written to.
template <class Pixel>
class Image {
 public:
  Image() = default;  ///< Empty: 0 x 0.
  /// Requires: width_px >= 0, height_px >= 0.
  Image(int width_px, int height_px, Pixel fill = {})
      : width_px_(width_px), height_px_(height_px), pixels_(area(width_px, height_px), fill) {}
  /// An image of somebody else's pixels, which are not copied.
  /// Requires: `pixels` holds width x height of them, row by row, and outlives the image and
  /// whatever that is moved to.
  [[nodiscard]] static Image borrowed(int width_px, int height_px, const Pixel* pixels) {
    Image image;
    image.width_px_ = width_px;
    image.height_px_ = height_px;
    image.borrowed_ = pixels;
    return image;
  }
  Image(const Image& other)
      : width_px_(other.width_px_),
        height_px_(other.height_px_),
        pixels_(other.pixels().begin(), other.pixels().end()) {}
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(Image other) noexcept {
    swap(other);
    return *this;
  }
  ~Image() = default;

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return area(width_px_, height_px_); }
  [[nodiscard]] bool is_borrowed() const noexcept { return borrowed_ != nullptr; }
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
    return data()[index(u, v)];
  }
  [[nodiscard]] Pixel& at(int u, int v) {
    assert(contains(u, v));
    own();
    return pixels_[index(u, v)];
  }
  [[nodiscard]] std::span<const Pixel> pixels() const noexcept { return {data(), size()}; }
  [[nodiscard]] std::span<Pixel> pixels() {
    own();
    return pixels_;
  }
  friend bool operator==(const Image& a, const Image& b) {
    return a.width_px_ == b.width_px_ && a.height_px_ == b.height_px_ &&
           std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin());
  }

 private:
  [[nodiscard]] static std::size_t area(int width_px, int height_px) noexcept {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
  [[nodiscard]] const Pixel* data() const noexcept {
    return borrowed_ != nullptr ? borrowed_ : pixels_.data();
  }
  void own() {
    if (borrowed_ == nullptr) return;
    pixels_.assign(borrowed_, borrowed_ + size());
    borrowed_ = nullptr;
  }
  void swap(Image& other) noexcept {
    std::swap(width_px_, other.width_px_);
    std::swap(height_px_, other.height_px_);
    std::swap(borrowed_, other.borrowed_);
    pixels_.swap(other.pixels_);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  const Pixel* borrowed_ = nullptr;  ///< Null: the pixels are our own.
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
/// 1 where the object is, 0 elsewhere.
using MaskImage = Image<std::uint8_t>;

}  // namespace hypermap
