// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A set of equal square pixels in plan, and its morphology with a disc.
///
/// Source: [serra] J. Serra, Image Analysis and Mathematical Morphology, 1982, chapter II
/// (dilation, erosion, closing, opening).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Pixels of a rectangle that are set; those outside are not. Row 0 has the least y.
class PlanMask {
 public:
  /// Nothing is set. Requires: both are 1 or more, or both 0.
  PlanMask(int cols, int rows);

  [[nodiscard]] int cols() const noexcept { return cols_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  /// Boundary: false outside.
  [[nodiscard]] bool at(int col, int row) const noexcept {
    return col >= 0 && row >= 0 && col < cols_ && row < rows_ && set_[index(col, row)] != 0;
  }
  /// Requires: inside.
  void set(int col, int row, bool value = true) noexcept { set_[index(col, row)] = value ? 1 : 0; }
  [[nodiscard]] std::size_t count() const noexcept;

  /// What is not set, inside.
  [[nodiscard]] PlanMask complement() const;
  /// What is set here or there. Requires: one size, as for the next one.
  PlanMask& operator|=(const PlanMask& other) noexcept;
  /// What is set here and there.
  PlanMask& operator&=(const PlanMask& other) noexcept;
  friend bool operator==(const PlanMask&, const PlanMask&) = default;

 private:
  [[nodiscard]] std::size_t index(int col, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(col);
  }

  int cols_;
  int rows_;
  std::vector<std::uint8_t> set_;
};

/// The pixels whose centres lie within `radius` pixels of that of a set one. Requires: radius >= 0,
/// for all that follow. Cost: O(pixels).
[[nodiscard]] PlanMask dilated(const PlanMask& mask, int radius);
/// The set pixels farther than `radius` from each pixel that is not set, among those inside.
[[nodiscard]] PlanMask eroded(const PlanMask& mask, int radius);
/// Dilated, then eroded: gaps too narrow for the disc are closed.
/// Requires: set pixels are farther than `radius` from the edge of the rectangle.
[[nodiscard]] PlanMask closed(const PlanMask& mask, int radius);
/// Eroded, then dilated: what is too narrow for the disc is gone.
[[nodiscard]] PlanMask opened(const PlanMask& mask, int radius);
/// With all pixels that no path over edges of pixels leads to from outside.
[[nodiscard]] PlanMask with_holes_filled(const PlanMask& mask);
/// With more pixels, so that no two that touch in a corner alone are set: outlines of what is left
/// touch nowhere. Cost: O(pixels) for each of a few passes.
[[nodiscard]] PlanMask without_corner_contacts(PlanMask mask);

/// Some of the parts of a mask that are connected over edges.
struct MaskParts {
  PlanMask mask;
  std::size_t num_parts = 0;
};

/// Without the parts that have less than `share` of the pixels of the largest.
/// Requires: fewer than 2^31 pixels. Cost: O(pixels).
[[nodiscard]] MaskParts without_specks(const PlanMask& mask, double share);

}  // namespace hypermap
