// SPDX-License-Identifier: BSD-3-Clause
#include "grid_texture.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

constexpr Rgb8 kUnknownColor{214, 219, 226};
constexpr Rgb8 kFreeColor{255, 255, 255};
constexpr Rgb8 kOccupiedColor{44, 52, 66};

std::uint8_t blend(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

Rgb8 occupancy_color(std::int8_t occupancy) {
  if (occupancy < 0) return kUnknownColor;
  const double share = occupancy / 100.0;
  return {blend(kFreeColor.r, kOccupiedColor.r, share),
          blend(kFreeColor.g, kOccupiedColor.g, share),
          blend(kFreeColor.b, kOccupiedColor.b, share)};
}

ColorImage texture_of(const OccupancyGrid& grid, int largest_side_px) {
  const GridGeometry& geometry = grid.geometry();
  const int step = (std::max(geometry.cols, geometry.rows) + largest_side_px - 1) / largest_side_px;
  Image<std::int8_t> merged(
      (geometry.cols + step - 1) / step, (geometry.rows + step - 1) / step, kUnknownCell);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      std::int8_t& cell = merged.at(col / step, row / step);
      cell = std::max(cell, grid.at({col, row}));
    }
  }
  ColorImage texture(merged.width_px(), merged.height_px());
  std::transform(
      merged.pixels().begin(), merged.pixels().end(), texture.pixels().begin(), occupancy_color);
  return texture;
}

ColorImage texture_of(const DrawnCells& cells, int largest_side_px) {
  const GridGeometry& geometry = cells.geometry;
  const int step = (std::max(geometry.cols, geometry.rows) + largest_side_px - 1) / largest_side_px;
  ColorImage texture((geometry.cols + step - 1) / step, (geometry.rows + step - 1) / step);
  for (int row = 0; row < texture.height_px(); ++row) {
    for (int col = 0; col < texture.width_px(); ++col) {
      texture.at(col, row) = cells.colors[geometry.index({col * step, row * step})];
    }
  }
  return texture;
}

}  // namespace hypermap
