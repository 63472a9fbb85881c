// SPDX-License-Identifier: BSD-3-Clause
#include "depth_pyramid.hpp"

#include "kernels/kernels.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace hypermap {
namespace {

std::size_t index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

DepthBounds unite(const DepthBounds& a, const DepthBounds& b) {
  return {std::min(a.min_m, b.min_m), std::max(a.max_m, b.max_m)};
}

/// How many levels until one tile is left.
std::size_t num_levels(int width, int height) {
  const auto tiles = static_cast<unsigned>(std::max(width, height));
  return static_cast<std::size_t>(std::bit_width(tiles - 1)) + 1;
}

}  // namespace

void DepthPyramid::Columns::fit(std::size_t width) {
  min.resize(width);
  max.resize(width);
  num_measured.resize(width);
}

void DepthPyramid::Columns::start_tile_row() {
  std::ranges::fill(min, std::numeric_limits<float>::infinity());
  std::ranges::fill(max, 0.0F);
  std::ranges::fill(num_measured, 0.0F);
}

void DepthPyramid::build(std::span<const float> depth_m,
                         int width_px,
                         std::span<const std::uint32_t> dropped,
                         const Workers& workers) {
  if (!dropped.empty()) {
    patched_.assign(depth_m.begin(), depth_m.end());
    for (const std::uint32_t pixel : dropped) patched_[pixel] = 0.0F;
    depth_m = patched_;
  }
  width_px_ = width_px;
  height_px_ = static_cast<int>(depth_m.size() / static_cast<std::size_t>(width_px));
  clean_.resize(depth_m.size());
  columns_.resize(workers.num_slots());
  for (Columns& columns : columns_) columns.fit(static_cast<std::size_t>(width_px));
  const int width = (width_px_ + kTile - 1) / kTile;
  const int height = (height_px_ + kTile - 1) / kTile;
  levels_.resize(num_levels(width, height));
  for (int i = 0; Level & level : levels_) {
    level.width = ((width - 1) >> i) + 1;
    level.height = ((height - 1) >> i) + 1;
    level.bounds.resize(index(0, level.height, level.width));
    ++i;
  }
  num_measured_.resize(levels_.front().bounds.size());
  workers.for_each(static_cast<std::size_t>(height), [&](std::size_t slot, std::size_t tile_row) {
    reduce_rows(depth_m, static_cast<int>(tile_row), columns_[slot]);
  });
  for (std::size_t i = 1; i < levels_.size(); ++i) build_level(levels_[i - 1], levels_[i]);
}

void DepthPyramid::reduce_rows(std::span<const float> depth_m, int tile_row, Columns& columns) {
  const auto width = static_cast<std::size_t>(width_px_);
  columns.start_tile_row();
  const int end_row = std::min(height_px_, (tile_row + 1) * kTile);
  for (int v = tile_row * kTile; v < end_row; ++v) {
    const std::size_t first = index(0, v, width_px_);
    kernels::best_kernels().summarise_row(depth_m.data() + first,
                                          width,
                                          {clean_.data() + first,
                                           columns.min.data(),
                                           columns.max.data(),
                                           columns.num_measured.data()});
  }
  Level& level = levels_.front();
  for (int tile = 0; tile < level.width; ++tile) {
    const auto begin = static_cast<std::size_t>(tile) * kTile;
    const std::size_t end = std::min(width, begin + kTile);
    DepthBounds bounds{columns.min[begin], columns.max[begin]};
    float num_measured = 0.0F;
    for (std::size_t u = begin; u < end; ++u) {
      bounds = unite(bounds, {columns.min[u], columns.max[u]});
      num_measured += columns.num_measured[u];
    }
    const std::size_t at = index(tile, tile_row, level.width);
    level.bounds[at] = bounds;
    num_measured_[at] = static_cast<std::uint8_t>(num_measured);
  }
}

void DepthPyramid::build_level(const Level& fine, Level& coarse) const {
  for (int y = 0; y < coarse.height; ++y) {
    const int below = std::min(2 * y + 1, fine.height - 1);
    for (int x = 0; x < coarse.width; ++x) {
      const int right = std::min(2 * x + 1, fine.width - 1);
      const auto at = [&](int tile_x, int tile_y) {
        return fine.bounds[index(tile_x, tile_y, fine.width)];
      };
      coarse.bounds[index(x, y, coarse.width)] = unite(unite(at(2 * x, 2 * y), at(right, 2 * y)),
                                                       unite(at(2 * x, below), at(right, below)));
    }
  }
}

DepthBounds DepthPyramid::bounds(const PixelSpan& rect) const noexcept {
  const int x_min = rect.u_min / kTile;
  const int y_min = rect.v_min / kTile;
  const int x_max = rect.u_max / kTile;
  const int y_max = rect.v_max / kTile;
  // At most three tiles along each side.
  const auto side = static_cast<unsigned>(std::max(x_max - x_min, y_max - y_min));
  const int shift = std::max(0, static_cast<int>(std::bit_width(side)) - 1);
  const Level& level = levels_[static_cast<std::size_t>(shift)];
  DepthBounds bounds{std::numeric_limits<float>::infinity(), 0.0F};
  for (int y = y_min >> shift; y <= y_max >> shift; ++y) {
    for (int x = x_min >> shift; x <= x_max >> shift; ++x) {
      bounds = unite(bounds, level.bounds[index(x, y, level.width)]);
    }
  }
  return bounds;
}

}  // namespace hypermap
