// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The nearest and the farthest depth in any part of an image, in a few lookups.
#pragma once

#include "integration/workers.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Pixels from (u_min, v_min) to (u_max, v_max), both included.
struct PixelSpan {
  int u_min = 0;
  int v_min = 0;
  int u_max = 0;
  int v_max = 0;
};

/// Bounds of the depths in a rectangle. Unit: metre.
struct DepthBounds {
  float min_m = 0.0F;  ///< 0 when some pixel has none.
  float max_m = 0.0F;  ///< 0 when all pixels have none.
};

/// Minimum and maximum of a depth image over tiles of 8 x 8 pixels, then over four of those each,
/// and so on. Reuses its memory.
class DepthPyramid {
 public:
  static constexpr int kTile = 8;

  /// `dropped`: positions of pixels that count as not measured. Throws std::bad_alloc.
  void build(std::span<const float> depth_m,
             int width_px,
             std::span<const std::uint32_t> dropped,
             const Workers& workers);

  /// The image, 0 where nothing was measured.
  [[nodiscard]] const std::vector<float>& clean() const noexcept { return clean_; }
  /// Bounds that may be wider than those of the rectangle: of the tiles that it touches.
  /// Requires: the rectangle lies in the image.
  [[nodiscard]] DepthBounds bounds(const PixelSpan& rect) const noexcept;
  [[nodiscard]] DepthBounds bounds() const noexcept { return levels_.back().bounds.front(); }

  [[nodiscard]] int tiles_per_row() const noexcept { return levels_.front().width; }
  /// How many pixels of each tile were measured, row-major.
  [[nodiscard]] const std::vector<std::uint8_t>& num_measured() const noexcept {
    return num_measured_;
  }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<DepthBounds> bounds;
  };
  struct Columns {
    std::vector<float> min;
    std::vector<float> max;
    std::vector<float> num_measured;

    /// Makes room for a row. Throws std::bad_alloc.
    void fit(std::size_t width);
    void start_tile_row();
  };
  void reduce_rows(std::span<const float> depth_m, int tile_row, Columns& columns);
  void build_level(const Level& fine, Level& coarse) const;

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<float> patched_;
  std::vector<float> clean_;
  std::vector<std::uint8_t> num_measured_;
  std::vector<Columns> columns_;  // one per slot of the workers
  std::vector<Level> levels_;
};

}  // namespace hypermap
