// SPDX-License-Identifier: BSD-3-Clause
#include "image_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// A window of more pixels costs as much as asking the tree.
constexpr int kMaxRadiusPx = 24;
/// Keeps the rounding of distances on the safe side.
constexpr double kSafety = 0.9999;
constexpr float kOutward = 1.001F;
/// Neighbouring points have neighbours about equally far.
constexpr float kLikely = 1.05F;

PixelRect rect_around(const std::vector<std::uint32_t>& pixels, int width_px) {
  PixelRect rect;
  const auto width = static_cast<std::uint32_t>(width_px);
  for (const std::uint32_t pixel : pixels) {
    const auto u = static_cast<int>(pixel % width);
    const auto v = static_cast<int>(pixel / width);
    rect = united(rect, {.u_begin = u, .v_begin = v, .u_end = u + 1, .v_end = v + 1});
  }
  return rect;
}

/// Beyond what an image shows, and below a micrometre: floats divide by what is between.
constexpr double kFarthestSquareM2 = 1e30;
constexpr double kLeastSquareM2 = 1e-12;

/// Radius of a window that holds `wanted` points if one of `radius_px` holds `num_found`.
int wider(int radius_px, std::size_t num_found, std::size_t wanted) {
  const double times = std::sqrt(static_cast<double>(wanted) /
                                 static_cast<double>(std::max(num_found, std::size_t{1})));
  return std::max(radius_px + 1, static_cast<int>(std::min(times, 4.0) * radius_px));
}

/// How many pixels are in each ring.
template <std::size_t kNumRings>
std::array<std::uint32_t, kNumRings> counts_of(std::span<const std::int32_t> rings) {
  // Neighbours are often in one ring: four counters of it do not wait for each other.
  constexpr std::size_t kNumCounters = 4;
  std::array<std::array<std::uint32_t, kNumRings>, kNumCounters> counters{};
  for (std::size_t i = 0; i < rings.size(); ++i) {
    ++counters[i % kNumCounters][static_cast<std::size_t>(rings[i])];
  }
  std::array<std::uint32_t, kNumRings> counts{};
  for (const auto& counter : counters) {
    for (std::size_t i = 0; i < kNumRings; ++i) counts[i] += counter[i];
  }
  return counts;
}

}  // namespace

ImageNeighbours::ImageNeighbours(const PixelCloud& cloud, const PinholeCamera& camera)
    : cloud_(cloud), camera_(camera), rect_(rect_around(cloud.pixels, camera.width_px)) {
  const std::size_t num_pixels =
      static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height());
  x_m_.assign(num_pixels, kInfinity);
  y_m_.assign(num_pixels, 0.0F);
  z_m_.assign(num_pixels, 0.0F);
  point_at_.assign(num_pixels, 0);
  const auto image_width = static_cast<std::uint32_t>(camera.width_px);
  for (std::size_t i = 0; i < cloud.pixels.size(); ++i) {
    const std::size_t at = cell_of(static_cast<int>(cloud.pixels[i] % image_width),
                                   static_cast<int>(cloud.pixels[i] / image_width));
    x_m_[at] = cloud.points_in_camera[i].x();
    y_m_[at] = cloud.points_in_camera[i].y();
    z_m_[at] = cloud.points_in_camera[i].z();
    point_at_[at] = static_cast<std::uint32_t>(i);
  }
}

std::size_t ImageNeighbours::cell_of(int u, int v) const noexcept {
  return static_cast<std::size_t>(v - rect_.v_begin) * static_cast<std::size_t>(rect_.width()) +
         static_cast<std::size_t>(u - rect_.u_begin);
}

PixelRect ImageNeighbours::window_around(std::uint32_t point, int radius_px) const noexcept {
  const auto width = static_cast<std::uint32_t>(camera_.width_px);
  const auto u = static_cast<int>(cloud_.pixels[point] % width);
  const auto v = static_cast<int>(cloud_.pixels[point] / width);
  return {.u_begin = std::max(u - radius_px, rect_.u_begin),
          .v_begin = std::max(v - radius_px, rect_.v_begin),
          .u_end = std::min(u + radius_px + 1, rect_.u_end),
          .v_end = std::min(v + radius_px + 1, rect_.v_end)};
}

std::array<float, 2> ImageNeighbours::radii_to_try_m(std::uint32_t point, std::size_t count) const {
  if (!asked_ || asked_->count < count) return {};
  const auto& points = cloud_.points_in_camera;
  const float radius_m = std::sqrt(asked_->square_m2);
  const float step_m = (points[point] - points[asked_->point]).norm();
  return {kLikely * radius_m, kOutward * (radius_m + step_m)};
}

std::optional<PixelRect> ImageNeighbours::window_within(std::uint32_t point, float radius_m) const {
  const Eigen::Vector3d at = cloud_.points_in_camera[point].cast<double>();
  const double square_m2 = static_cast<double>(radius_m) * static_cast<double>(radius_m);
  const double depth_m2 = at.z() * at.z() - square_m2;
  if (!(square_m2 > kLeastSquareM2 && depth_m2 > 0.0)) return std::nullopt;
  // Planes through the camera's centre that touch the ball, x = slope z, and so for y.
  const auto slopes = [&](double coordinate_m) {
    const double middle = coordinate_m * at.z();
    const double off = std::sqrt(square_m2 * (coordinate_m * coordinate_m + depth_m2));
    return std::pair((middle - off) / depth_m2, (middle + off) / depth_m2);
  };
  const auto [left, right] = slopes(at.x());
  const auto [top, bottom] = slopes(at.y());
  constexpr double kMostPx = 2.0 * kMaxRadiusPx;
  const bool is_small =
      (right - left) * camera_.fx_px <= kMostPx && (bottom - top) * camera_.fy_px <= kMostPx;
  if (!is_small) return std::nullopt;
  const auto first = [](double px) { return static_cast<int>(std::ceil(px)); };
  const auto end = [](double px) { return static_cast<int>(std::floor(px)) + 1; };
  return PixelRect{.u_begin = std::max(first(camera_.cx_px + camera_.fx_px * left), rect_.u_begin),
                   .v_begin = std::max(first(camera_.cy_px + camera_.fy_px * top), rect_.v_begin),
                   .u_end = std::min(end(camera_.cx_px + camera_.fx_px * right), rect_.u_end),
                   .v_end = std::min(end(camera_.cy_px + camera_.fy_px * bottom), rect_.v_end)};
}

float ImageNeighbours::certain_square_m2(std::uint32_t point,
                                         const PixelRect& window) const noexcept {
  const Eigen::Vector3d at = cloud_.points_in_camera[point].cast<double>();
  double least_m2 = kFarthestSquareM2;
  // The plane x = slope z holds the camera's centre and all points that a column shows.
  const auto keep_from = [&](double coordinate_m, double slope) {
    const double off_m = coordinate_m - slope * at.z();
    least_m2 = std::min(least_m2, kSafety * off_m * off_m / (1.0 + slope * slope));
  };
  const auto column = [&](int u) { keep_from(at.x(), (u - camera_.cx_px) / camera_.fx_px); };
  const auto row = [&](int v) { keep_from(at.y(), (v - camera_.cy_px) / camera_.fy_px); };
  if (window.u_begin > rect_.u_begin) column(window.u_begin - 1);
  if (window.u_end < rect_.u_end) column(window.u_end);
  if (window.v_begin > rect_.v_begin) row(window.v_begin - 1);
  if (window.v_end < rect_.v_end) row(window.v_end);
  return least_m2 < kLeastSquareM2 ? 0.0F : static_cast<float>(least_m2);
}

ImageNeighbours::RingCounts ImageNeighbours::measure(std::uint32_t point,
                                                     const PixelRect& window,
                                                     float limit_m2) {
  constexpr auto kBeyond = static_cast<float>(kNumRings);
  const Eigen::Vector3f from = cloud_.points_in_camera[point];
  const float rings_per_m2 = kBeyond / limit_m2;
  const auto width = static_cast<std::size_t>(window.width());
  const std::size_t num_pixels = width * static_cast<std::size_t>(window.height());
  squares_m2_.resize(num_pixels);
  rings_.resize(num_pixels);
  points_.resize(num_pixels);
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const std::size_t begin = cell_of(window.u_begin, v);
    const std::size_t row = static_cast<std::size_t>(v - window.v_begin) * width;
    const float* const x_m = x_m_.data() + begin;
    const float* const y_m = y_m_.data() + begin;
    const float* const z_m = z_m_.data() + begin;
    float* const squares_m2 = squares_m2_.data() + row;
    std::int32_t* const rings = rings_.data() + row;
    std::copy_n(point_at_.data() + begin, width, points_.data() + row);
    for (std::size_t i = 0; i < width; ++i) {
      const float off_x_m = x_m[i] - from.x();
      const float off_y_m = y_m[i] - from.y();
      const float off_z_m = z_m[i] - from.z();
      squares_m2[i] = off_x_m * off_x_m + off_y_m * off_y_m + off_z_m * off_z_m;
      const float ring = squares_m2[i] * rings_per_m2;
      rings[i] = static_cast<std::int32_t>(ring < kBeyond ? ring : kBeyond);
    }
  }
  return counts_of<kNumRings + 1>(rings_);
}

ImageNeighbours::LastRing ImageNeighbours::last_ring(const RingCounts& rings,
                                                     std::size_t count) noexcept {
  LastRing last;
  while (last.num_before + rings[static_cast<std::size_t>(last.ring)] < count) {
    last.num_before += rings[static_cast<std::size_t>(last.ring++)];
  }
  return last;
}

void ImageNeighbours::find_candidates(const RingCounts& rings, const LastRing& last) {
  within_.resize(last.num_before + 1);
  at_limit_.resize(rings[static_cast<std::size_t>(last.ring)] + 1);
  std::uint32_t* within = within_.data();
  std::uint32_t* at_limit = at_limit_.data();
  const auto num_pixels = static_cast<std::uint32_t>(rings_.size());
  for (std::uint32_t pixel = 0; pixel < num_pixels; ++pixel) {
    const std::int32_t ring = rings_[pixel];
    // Written in any case and kept by the step: no branch that nothing can foresee.
    *within = pixel;
    within += ring < last.ring ? 1 : 0;
    *at_limit = pixel;
    at_limit += ring == last.ring ? 1 : 0;
  }
  within_.pop_back();
  sort_undecided();
}

void ImageNeighbours::sort_undecided() {
  at_limit_.pop_back();
  undecided_.resize(at_limit_.size());
  std::ranges::transform(at_limit_, undecided_.begin(), [&](std::uint32_t pixel) {
    return Candidate{.square_m2 = squares_m2_[pixel], .point = points_[pixel]};
  });
  std::ranges::sort(undecided_);
}

void ImageNeighbours::put_first(const RingCounts& rings, std::size_t num_first) {
  const LastRing last = last_ring(rings, num_first);
  const std::size_t num_undecided = rings[static_cast<std::size_t>(last.ring)];
  at_limit_.resize(num_undecided + 1);
  std::uint32_t* before = nearest_.data();
  std::uint32_t* after = before + within_.size() - 1;
  std::uint32_t* at_limit = at_limit_.data();
  for (const std::uint32_t pixel : within_) {
    const std::int32_t ring = rings_[pixel];
    // When all of a kind are there, the next would stand where an undecided one will.
    *before = points_[pixel];
    before += ring < last.ring ? 1 : 0;
    *at_limit = pixel;
    at_limit += ring == last.ring ? 1 : 0;
    *after = points_[pixel];
    after -= ring > last.ring ? 1 : 0;
  }
  sort_undecided();
  std::ranges::transform(undecided_,
                         nearest_.begin() + static_cast<std::ptrdiff_t>(last.num_before),
                         &Candidate::point);
}

std::span<const std::uint32_t> ImageNeighbours::nearest_in(std::uint32_t point,
                                                           const RingCounts& rings,
                                                           std::size_t count,
                                                           std::size_t num_first) {
  const LastRing last = last_ring(rings, count);
  find_candidates(rings, last);
  nearest_.resize(count);
  const auto decided = std::span(undecided_).first(count - last.num_before);
  asked_ = Asked{.point = point, .count = count, .square_m2 = decided.back().square_m2};
  std::ranges::transform(
      decided, nearest_.begin() + static_cast<std::ptrdiff_t>(last.num_before), &Candidate::point);
  if (num_first < last.num_before) {
    put_first(rings, num_first);
  } else {
    std::ranges::transform(
        within_, nearest_.begin(), [&](std::uint32_t pixel) { return points_[pixel]; });
  }
  return nearest_;
}

std::span<const std::uint32_t> ImageNeighbours::nearest(std::uint32_t point,
                                                        std::size_t count,
                                                        std::size_t num_first) {
  const std::size_t wanted = std::min(count, cloud_.pixels.size());
  for (const float radius_m : radii_to_try_m(point, wanted)) {
    const auto window = window_within(point, radius_m);
    if (!window) continue;
    const RingCounts rings = measure(point, *window, radius_m * radius_m);
    if (rings_.size() - rings.back() >= wanted) return nearest_in(point, rings, wanted, num_first);
  }
  for (int radius_px = radius_px_; radius_px <= kMaxRadiusPx;) {
    const PixelRect window = window_around(point, radius_px);
    const RingCounts rings = measure(point, window, certain_square_m2(point, window));
    const std::size_t num_found = rings_.size() - rings.back();
    if (num_found >= wanted) {
      radius_px_ = num_found > 2 * wanted ? std::max(radius_px - 1, 1) : radius_px;
      return nearest_in(point, rings, wanted, num_first);
    }
    radius_px = wider(radius_px, num_found, wanted);
  }
  if (!tree_) tree_.emplace(cloud_.points_in_camera);
  return tree_->nearest(point, wanted);
}

}  // namespace hypermap
