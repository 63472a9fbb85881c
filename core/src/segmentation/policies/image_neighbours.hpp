// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Nearest neighbours of points that lie in an image.
#pragma once

#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "segmentation_policies.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hypermap {

/// Which points of a depth image are nearest to one of them in space.
///
/// Exact: what lies r pixels aside is at least as far as the plane through the camera's centre and
/// that column or row, so a window of pixels that holds enough points nearer than that holds all
/// that are. Where depth scatters so much that no small window does, a kd tree answers.
/// Cost: about two distances for each neighbour on a surface; 20 B for each pixel of the smallest
/// rectangle around the points.
/// Threads: an object answers one caller at a time.
class ImageNeighbours {
 public:
  /// Requires: `cloud` outlives this; its points are those that `camera` sees at its pixels.
  ImageNeighbours(const PixelCloud& cloud, const PinholeCamera& camera);
  ~ImageNeighbours();
  ImageNeighbours(const ImageNeighbours&) = delete;
  ImageNeighbours& operator=(const ImageNeighbours&) = delete;

  /// The `count` points nearest to `point`, itself among them, in no order; of equally far ones
  /// those of the first pixels, unless a tree answers. Boundary: all when there are no more.
  /// Valid until the next call.
  [[nodiscard]] std::span<const std::uint32_t> nearest(std::uint32_t point, std::size_t count);

 private:
  struct Tree;

  /// Rings of equal area around a point: on a surface they hold equally many.
  static constexpr std::size_t kNumRings = 64;
  /// How many points of a window are in each ring; in the last one those beyond all.
  using RingCounts = std::array<std::uint32_t, kNumRings + 1>;
  struct Undecided {
    float square_m2 = 0.0F;
    std::uint32_t point = 0;
    friend auto operator<=>(const Undecided&, const Undecided&) = default;
  };

  [[nodiscard]] std::size_t cell_of(int u, int v) const noexcept;
  [[nodiscard]] PixelRect window_around(std::uint32_t point, int radius_px) const noexcept;
  /// What lies outside the window around `point` is not nearer.
  [[nodiscard]] float certain_square_m2(std::uint32_t point,
                                        const PixelRect& window) const noexcept;
  /// Square distances and rings of all pixels of the window; rings end at `limit_m2`.
  RingCounts measure(std::uint32_t point, const PixelRect& window, float limit_m2);
  /// Requires: as many in the rings.
  [[nodiscard]] std::span<const std::uint32_t> nearest_in(const PixelRect& window,
                                                          const RingCounts& rings,
                                                          std::size_t count);
  [[nodiscard]] std::span<const std::uint32_t> nearest_by_tree(std::uint32_t point,
                                                               std::size_t count);

  const PixelCloud& cloud_;
  PinholeCamera camera_;
  PixelRect rect_;
  /// Of each pixel of `rect_`, row by row: where its point is, infinitely far where there is none.
  std::vector<float> x_m_;
  std::vector<float> y_m_;
  std::vector<float> z_m_;
  std::vector<std::uint32_t> point_at_;  ///< Position in `cloud_`.
  std::vector<float> squares_m2_;        ///< Of the pixels of the window that was measured last.
  std::vector<std::int32_t> rings_;
  std::vector<Undecided> undecided_;
  std::vector<std::uint32_t> nearest_;
  std::unique_ptr<Tree> tree_;
  int radius_px_ = 4;  ///< Of the window that sufficed last; neighbours need about the same.
};

}  // namespace hypermap
