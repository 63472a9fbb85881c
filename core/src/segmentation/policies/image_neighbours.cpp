// SPDX-License-Identifier: BSD-3-Clause
#include "image_neighbours.hpp"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

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

struct ImageNeighbours::Tree {
  pcl::search::KdTree<pcl::PointXYZ> tree;
  pcl::Indices indices;
  std::vector<float> squares_m2;
};

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

ImageNeighbours::~ImageNeighbours() = default;

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
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const std::size_t begin = cell_of(window.u_begin, v);
    const std::size_t row = static_cast<std::size_t>(v - window.v_begin) * width;
    const float* const x_m = x_m_.data() + begin;
    const float* const y_m = y_m_.data() + begin;
    const float* const z_m = z_m_.data() + begin;
    float* const squares_m2 = squares_m2_.data() + row;
    std::int32_t* const rings = rings_.data() + row;
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

std::span<const std::uint32_t> ImageNeighbours::nearest_in(const PixelRect& window,
                                                           const RingCounts& rings,
                                                           std::size_t count) {
  std::size_t num_within = 0;
  std::int32_t last_ring = 0;
  for (; num_within + rings[static_cast<std::size_t>(last_ring)] < count; ++last_ring) {
    num_within += rings[static_cast<std::size_t>(last_ring)];
  }
  nearest_.resize(count + 1);
  undecided_.resize(rings[static_cast<std::size_t>(last_ring)] + 1);
  std::uint32_t* nearest = nearest_.data();
  Undecided* undecided = undecided_.data();
  const std::int32_t* ring = rings_.data();
  const float* square_m2 = squares_m2_.data();
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const std::uint32_t* point = point_at_.data() + cell_of(window.u_begin, v);
    for (int u = window.u_begin; u < window.u_end; ++u, ++point, ++ring, ++square_m2) {
      // Written in any case and kept by the step: no branch that nothing can foresee.
      *nearest = *point;
      nearest += *ring < last_ring ? 1 : 0;
      *undecided = {.square_m2 = *square_m2, .point = *point};
      undecided += *ring == last_ring ? 1 : 0;
    }
  }
  undecided_.pop_back();
  std::ranges::sort(undecided_);
  for (std::size_t i = num_within; i < count; ++i) nearest_[i] = undecided_[i - num_within].point;
  nearest_.resize(count);
  return nearest_;
}

std::span<const std::uint32_t> ImageNeighbours::nearest_by_tree(std::uint32_t point,
                                                                std::size_t count) {
  if (tree_ == nullptr) {
    const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    cloud->reserve(cloud_.points_in_camera.size());
    for (const Eigen::Vector3f& at : cloud_.points_in_camera) {
      cloud->push_back({at.x(), at.y(), at.z()});
    }
    tree_ = std::make_unique<Tree>();
    tree_->tree.setInputCloud(cloud);
  }
  tree_->tree.nearestKSearch(
      static_cast<int>(point), static_cast<int>(count), tree_->indices, tree_->squares_m2);
  nearest_.assign(tree_->indices.begin(), tree_->indices.end());
  return nearest_;
}

std::span<const std::uint32_t> ImageNeighbours::nearest(std::uint32_t point, std::size_t count) {
  const std::size_t wanted = std::min(count, cloud_.pixels.size());
  for (int radius_px = radius_px_; radius_px <= kMaxRadiusPx;) {
    const PixelRect window = window_around(point, radius_px);
    const RingCounts rings = measure(point, window, certain_square_m2(point, window));
    const std::size_t num_found = rings_.size() - rings.back();
    if (num_found >= wanted) {
      radius_px_ = num_found > 2 * wanted ? std::max(radius_px - 1, 1) : radius_px;
      return nearest_in(window, rings, wanted);
    }
    radius_px = wider(radius_px, num_found, wanted);
  }
  return nearest_by_tree(point, wanted);
}

}  // namespace hypermap
