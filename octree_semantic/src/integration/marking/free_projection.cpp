// SPDX-License-Identifier: BSD-3-Clause
#include "free_projection.hpp"

#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hypermap {
namespace {

/// Margin of the test of whole bricks, relative and in pixels: rounding in the test of single
/// corners cannot disagree.
constexpr float kSpare = 1e-4F;
constexpr float kSparePx = 0.05F;

const BrickWords kNoCorners{};
const BrickWords kAllCorners = [] {
  BrickWords words{};
  words.fill(~std::uint64_t{0});
  return words;
}();

/// Lower and upper bound of something.
struct Interval {
  float low = 0.0F;
  float high = 0.0F;
};

/// Bounds of middle +- half over a positive depth, shifted.
Interval projected(float middle, float half, const Interval& depth, float shift) {
  const float low = middle - half;
  const float high = middle + half;
  return {low / (low >= 0.0F ? depth.high : depth.low) + shift - kSparePx,
          high / (high >= 0.0F ? depth.low : depth.high) + shift + kSparePx};
}

/// Where the corners of a brick may fall in the image.
struct Footprint {
  PixelSpan rect;
  bool whole = true;  // none falls outside
};

/// None when all fall outside.
std::optional<Footprint> footprint(const Interval& u,
                                   const Interval& v,
                                   float width,
                                   float height) {
  if (!(u.high >= 0.0F && v.high >= 0.0F && u.low < width && v.low < height)) return std::nullopt;
  Footprint result;
  result.whole = u.low >= 0.0F && v.low >= 0.0F && u.high < width && v.high < height;
  result.rect = {static_cast<int>(std::max(u.low, 0.0F)),
                 static_cast<int>(std::max(v.low, 0.0F)),
                 static_cast<int>(std::min(u.high, width - 1.0F)),
                 static_cast<int>(std::min(v.high, height - 1.0F))};
  return result;
}

}  // namespace

void FreeProjection::mark(const RgbdFrame& frame,
                          const DepthPyramid& pyramid,
                          double resolution_m,
                          double max_range_m,
                          const WindowGeometry& window,
                          const Workers& workers,
                          BitLayer& passed) {
  set_up(frame, pyramid, resolution_m, max_range_m, window);
  const std::size_t num_columns = window.num_bricks(0) * window.num_bricks(1);
  workers.for_each(num_columns,
                   [&](std::size_t, std::size_t column) { test_column(pyramid, column, window); });
  workers.for_each(num_columns,
                   [&](std::size_t, std::size_t column) { mark_column(column, window, passed); });
}

void FreeProjection::set_up(const RgbdFrame& frame,
                            const DepthPyramid& pyramid,
                            double resolution_m,
                            double max_range_m,
                            const WindowGeometry& window) {
  const PinholeCamera& camera = frame.camera;
  const Eigen::Matrix3d camera_from_map = frame.map_from_camera.isometry().linear().transpose();
  const Eigen::Vector3d focal(camera.fx_px, camera.fy_px, 1.0);
  const Eigen::Matrix3d scaled = focal.asDiagonal() * camera_from_map;
  const Eigen::Vector3d corner(window.corner(0), window.corner(1), window.corner(2));
  const Eigen::Vector3d corner_in_map =
      (corner - Eigen::Vector3d::Constant(kOriginKey)) * resolution_m;
  const Eigen::Vector3d origin =
      scaled * (corner_in_map - frame.map_from_camera.isometry().translation());
  const Eigen::Matrix3d per_voxel = scaled * resolution_m;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    origin_[axis] = origin[i];
    for (Eigen::Index step = 0; step < 3; ++step) {
      per_brick_[static_cast<std::size_t>(step)][axis] = per_voxel(i, step) * kBrickEdge;
    }
    // The corners of a brick are 7 steps apart.
    middle_[axis] = static_cast<float>(3.5 * per_voxel.row(i).sum());
    half_[axis] = static_cast<float>(3.5 * per_voxel.row(i).cwiseAbs().sum()) * (1.0F + kSpare);
  }
  for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
    const Eigen::Vector3d steps(
        gather_bits(cell) & 7U, gather_bits(cell >> 1U) & 7U, gather_bits(cell >> 2U) & 7U);
    const Eigen::Vector3d at = per_voxel * steps;
    projection_.x[cell] = static_cast<float>(at.x());
    projection_.y[cell] = static_cast<float>(at.y());
    projection_.z[cell] = static_cast<float>(at.z());
  }
  max_range_m_ = static_cast<float>(max_range_m);
  radius_m_ = static_cast<float>(3.5 * std::numbers::sqrt3 * resolution_m);
  projection_.depth_m = pyramid.clean().data();
  projection_.width_px = camera.width_px;
  projection_.width = static_cast<float>(camera.width_px);
  projection_.height = static_cast<float>(camera.height_px);
  projection_.u0 = static_cast<float>(camera.cx_px + 0.5);
  projection_.v0 = static_cast<float>(camera.cy_px + 0.5);
  projection_.max_squared_m2 = max_range_m_ * max_range_m_;
  projection_.per_fx = static_cast<float>(1.0 / camera.fx_px);
  projection_.per_fy = static_cast<float>(1.0 / camera.fy_px);
  visible_corners_.resize(window.num_bricks());
  corners_.resize(window.num_bricks());
}

void FreeProjection::test_column(const DepthPyramid& pyramid,
                                 std::size_t column,
                                 const WindowGeometry& window) {
  const std::size_t row = column / window.num_bricks(1);
  const auto x = static_cast<double>(row);
  const auto y = static_cast<double>(column % window.num_bricks(1));
  for (std::size_t z = 0; z < window.num_bricks(2); ++z) {
    const std::size_t brick = column * window.num_bricks(2) + z;
    std::array<float, 3> first{};
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = static_cast<float>(origin_[i] + per_brick_[0][i] * x + per_brick_[1][i] * y +
                                    per_brick_[2][i] * static_cast<double>(z));
    }
    visible_corners_[brick] = test_brick(pyramid, first, corners_[brick]);
  }
}

FreeProjection::VisibleCorners FreeProjection::test_brick(const DepthPyramid& pyramid,
                                                          const std::array<float, 3>& first,
                                                          BrickWords& corners) const {
  const float x = first[0] + middle_[0];
  const float y = first[1] + middle_[1];
  const float z = first[2] + middle_[2];
  const Interval depth{z - half_[2], z + half_[2]};
  if (!(depth.high > 0.0F && depth.low <= pyramid.bounds().max_m)) return VisibleCorners::kNothing;
  const float metric_x = x * projection_.per_fx;
  const float metric_y = y * projection_.per_fy;
  const float distance_m = std::sqrt(metric_x * metric_x + metric_y * metric_y + z * z);
  if (distance_m * (1.0F - kSpare) > max_range_m_ + radius_m_) return VisibleCorners::kNothing;
  const bool within = (distance_m + radius_m_) * (1.0F + kSpare) < max_range_m_;
  // The sensor stands among the corners, or nearly so: they fall anywhere.
  if (depth.low > kSpare * half_[2]) {
    const auto print = footprint(projected(x, half_[0], depth, projection_.u0),
                                 projected(y, half_[1], depth, projection_.v0),
                                 projection_.width,
                                 projection_.height);
    if (!print) return VisibleCorners::kNothing;
    const DepthBounds measured = pyramid.bounds(print->rect);
    if (depth.low * (1.0F - kSpare) > measured.max_m) return VisibleCorners::kNothing;
    if (within && print->whole && depth.high * (1.0F + kSpare) < measured.min_m)
      return VisibleCorners::kAll;
  }
  kernels::best_kernels().test_corners(projection_, first.data(), !within, corners.data());
  return corners == kNoCorners ? VisibleCorners::kNothing : VisibleCorners::kSome;
}

const BrickWords& FreeProjection::corners_of(std::size_t brick) const noexcept {
  switch (visible_corners_[brick]) {
    case VisibleCorners::kSome:
      return corners_[brick];
    case VisibleCorners::kAll:
      return kAllCorners;
    case VisibleCorners::kNothing:
      break;
  }
  return kNoCorners;
}

void FreeProjection::mark_column(std::size_t column,
                                 const WindowGeometry& window,
                                 BitLayer& passed) const {
  const std::size_t num_z = window.num_bricks(2);
  const std::size_t to_next_x = window.num_bricks(1) * num_z;
  const bool has_next_x = column / window.num_bricks(1) + 1 < window.num_bricks(0);
  const bool has_next_y = column % window.num_bricks(1) + 1 < window.num_bricks(1);
  for (std::size_t z = 0; z < num_z; ++z) {
    const std::size_t brick = column * num_z + z;
    std::array<const BrickWords*, 8> corners{};
    bool any = false;
    for (std::size_t i = 0; i < 8; ++i) {
      const bool next_x = (i & 1U) != 0;
      const bool next_y = (i & 2U) != 0;
      const bool next_z = (i & 4U) != 0;
      const bool exists =
          (!next_x || has_next_x) && (!next_y || has_next_y) && (!next_z || z + 1 < num_z);
      const std::size_t neighbour =
          brick + (next_x ? to_next_x : 0) + (next_y ? num_z : 0) + (next_z ? 1 : 0);
      corners[i] = exists ? &corners_of(neighbour) : &kNoCorners;
      any |= corners[i] != &kNoCorners;
    }
    if (!any) continue;
    const BrickWords voxels =
        visible_corners_[brick] == VisibleCorners::kAll ? kAllCorners : voxels_of_corners(corners);
    if (voxels != kNoCorners) passed.unite_brick(brick, voxels.data());
  }
}

}  // namespace hypermap
