// SPDX-License-Identifier: BSD-3-Clause
#include "mask_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hypermap {
namespace {

/// Between which two of `size` cells a place lies, in cells, and how near to the second.
struct CellPair {
  int first = 0;
  int second = 0;
  double share = 0.0;
};

CellPair cells_around(double place, int size) {
  const double at = std::clamp(place - 0.5, 0.0, static_cast<double>(size - 1));
  const int first = static_cast<int>(at);
  return {first, std::min(first + 1, size - 1), at - first};
}

double mix(double first, double second, double share) {
  return first + share * (second - first);
}

double value_at(const MaskGrid& grid, const CellPair& column, const CellPair& row) {
  const auto cell = [&](int u, int v) {
    return static_cast<double>(
        grid.values[static_cast<std::size_t>(v) * static_cast<std::size_t>(grid.width) +
                    static_cast<std::size_t>(u)]);
  };
  return mix(mix(cell(column.first, row.first), cell(column.second, row.first), column.share),
             mix(cell(column.first, row.second), cell(column.second, row.second), column.share),
             row.share);
}

/// The first pixel whose middle is at `edge` or beyond, within the image.
int first_pixel(double edge, int size) {
  return static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, static_cast<double>(size)));
}

}  // namespace

bool is_finite(const MaskGrid& grid) {
  return std::ranges::all_of(grid.values, [](float value) { return std::isfinite(value); });
}

MaskImage drawn(const MaskGrid& grid,
                const PixelBox& box_px,
                const InputPlacement& placement,
                int image_width_px,
                int image_height_px) {
  MaskImage mask(image_width_px, image_height_px);
  const double cells_per_px_u = grid.width / grid.place_px.width_px();
  const double cells_per_px_v = grid.height / grid.place_px.height_px();
  const int u_end = first_pixel(box_px.u_max_px, image_width_px);
  const int v_end = first_pixel(box_px.v_max_px, image_height_px);
  for (int v = first_pixel(box_px.v_min_px, image_height_px); v < v_end; ++v) {
    const double input_v = (v + 0.5) * placement.scale_v + placement.offset_v_px;
    const CellPair row =
        cells_around((input_v - grid.place_px.v_min_px) * cells_per_px_v, grid.height);
    for (int u = first_pixel(box_px.u_min_px, image_width_px); u < u_end; ++u) {
      const double input_u = (u + 0.5) * placement.scale_u + placement.offset_u_px;
      const CellPair column =
          cells_around((input_u - grid.place_px.u_min_px) * cells_per_px_u, grid.width);
      mask.at(u, v) =
          static_cast<std::uint8_t>(value_at(grid, column, row) > grid.threshold ? 1 : 0);
    }
  }
  return mask;
}

}  // namespace hypermap
