// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Nearest neighbours of points that lie in an image.
#pragma once

#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "segmentation_policies.hpp"
#include "tree_neighbours.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Which points of a depth image are nearest to one of them in space.
///
/// Exact: what lies r pixels aside is at least as far as the plane through the camera's centre and
/// that column or row, so a window of pixels that holds enough points nearer than that holds all
/// that are. How far that is at most follows from the point that was asked for before: its
/// neighbours are no farther from this one than from it, and it from this one. Where depth scatters
/// so much that no small window does, a kd tree answers.
/// Cost: about three distances for each neighbour on a surface; 20 B for each pixel of the smallest
/// rectangle around the points.
/// Threads: an object answers one caller at a time.
class ImageNeighbours {
 public:
  /// Requires: `cloud` outlives this; its points are those that `camera` sees at its pixels.
  ImageNeighbours(const PixelCloud& cloud, const PinholeCamera& camera);

  /// The `count` points nearest to `point`, itself among them; of equally far ones those of the
  /// first pixels, unless a tree answers. The nearest `num_first` of them come first; else they are
  /// in no order. Requires: num_first > 0. Boundary: all when there are no more. Valid until the
  /// next call.
  [[nodiscard]] std::span<const std::uint32_t> nearest(std::uint32_t point,
                                                       std::size_t count,
                                                       std::size_t num_first);

 private:
  /// Rings of equal area around a point: on a surface they hold equally many.
  static constexpr std::size_t kNumRings = 64;
  /// How many points of a window are in each ring; in the last one those beyond all.
  using RingCounts = std::array<std::uint32_t, kNumRings + 1>;
  struct Candidate {
    float square_m2 = 0.0F;
    std::uint32_t point = 0;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
  };
  /// The point that was asked for last, and how far the last of its neighbours is.
  struct Asked {
    std::uint32_t point = 0;
    std::size_t count = 0;
    float square_m2 = 0.0F;
  };
  /// Where a number of points that are nearest ends: in this ring, before which there are so many.
  struct LastRing {
    std::int32_t ring = 0;
    std::size_t num_before = 0;
  };

  /// Requires: as many in the rings.
  [[nodiscard]] static LastRing last_ring(const RingCounts& rings, std::size_t count) noexcept;
  [[nodiscard]] std::size_t cell_of(int u, int v) const noexcept;
  [[nodiscard]] PixelRect window_around(std::uint32_t point, int radius_px) const noexcept;
  /// Within how far as many points are, after what was asked before: probably, and surely. Zeros
  /// when that does not tell.
  [[nodiscard]] std::array<float, 2> radii_to_try_m(std::uint32_t point, std::size_t count) const;
  /// All pixels that may be so near; none when that is no small window.
  [[nodiscard]] std::optional<PixelRect> window_within(std::uint32_t point, float radius_m) const;
  /// What lies outside the window around `point` is not nearer.
  [[nodiscard]] float certain_square_m2(std::uint32_t point,
                                        const PixelRect& window) const noexcept;
  /// Square distances and rings of all pixels of the window; rings end at `limit_m2`.
  RingCounts measure(std::uint32_t point, const PixelRect& window, float limit_m2);
  /// Requires: as many in the rings.
  [[nodiscard]] std::span<const std::uint32_t> nearest_in(std::uint32_t point,
                                                          const RingCounts& rings,
                                                          std::size_t count,
                                                          std::size_t num_first);
  /// Pixels of the window in rings before `last`, and the points in it, by their distance.
  void find_candidates(const RingCounts& rings, const LastRing& last);
  void sort_undecided();
  /// Of those before the last ring the nearest `num_first` come first in `nearest_`.
  /// Requires: no more than these are.
  void put_first(const RingCounts& rings, std::size_t num_first);

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
  std::vector<std::uint32_t> points_;    ///< Those of its pixels.
  std::vector<std::uint32_t> within_;    ///< Its pixels before the last ring.
  std::vector<std::uint32_t> at_limit_;  ///< Its pixels in a last ring,
  std::vector<Candidate> undecided_;     ///< and their points, by distance.
  std::vector<std::uint32_t> nearest_;
  std::optional<TreeNeighbours> tree_;  ///< Once it was needed.
  std::optional<Asked> asked_;
  int radius_px_ = 4;  ///< Of the window that sufficed last; neighbours need about the same.
};

}  // namespace hypermap
