// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/low_obstacles.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

/// Rounding of heights and of sums decides nothing.
constexpr double kSlackM = 1e-6;
/// Where no leaf is occupied.
constexpr float kNoTop = -std::numeric_limits<float>::infinity();

constexpr OptionRow kLowObstacleRows[] = {
    option::number<&LowObstacleOptions::wall_m>(
        "wall_m",
        option::above(0, 100),
        {.unit = "m", .effect = "What reaches so high is a wall, or as good as one."}),
    option::number<&LowObstacleOptions::min_free_share>(
        "min_free_share",
        option::above(0, 1),
        {.effect =
             "An obstacle was looked over when so much of the height above it was seen free."}),
};

/// From the floor to the height of walls; what lies below the floor is a floor.
HeightBand below_walls(const LowObstacleOptions& options) {
  return over(options.floor, {.min_m = 0.0, .max_m = options.wall_m});
}

/// Of each cell the top of its highest occupied leaf; that of the band where it reaches so high.
std::vector<float> tops_of(const GridGeometry& geometry,
                           const LeafSource& leaves,
                           const HeightBand& band) {
  std::vector<float> tops(geometry.num_cells(), kNoTop);
  // A leaf that begins at a wall's height is above it, not in it; a lintel is such a leaf.
  leaves([&](const LeafSample& leaf) {
    if (!leaf.occupied) return;
    const double top_m = std::min(leaf.centre_in_map.z() + leaf.edge_m / 2, band.max_m);
    for_each_column(geometry, band, leaf, [&](Cell cell, double, double) {
      float& top = tops[geometry.index(cell)];
      top = std::max(top, static_cast<float>(top_m));
    });
  });
  return tops;
}

/// Of each cell the height that was seen free between its top and that of the band.
std::vector<float> free_above(const GridGeometry& geometry,
                              const LeafSource& leaves,
                              const HeightBand& band,
                              const std::vector<float>& tops) {
  std::vector<float> free_m(tops.size(), 0.0F);
  leaves([&](const LeafSample& leaf) {
    if (leaf.occupied) return;
    const double low_m = leaf.centre_in_map.z() - leaf.edge_m / 2;
    const double high_m = std::min(leaf.centre_in_map.z() + leaf.edge_m / 2, band.max_m);
    for_each_column(geometry, band, leaf, [&](Cell cell, double covered, double) {
      const std::size_t i = geometry.index(cell);
      const double above_m = high_m - std::max(low_m, static_cast<double>(tops[i]));
      if (above_m > 0.0) free_m[i] += static_cast<float>(covered * above_m);
    });
  });
  return free_m;
}

}  // namespace

const OptionTable& option_table(const LowObstacleOptions&) {
  static constexpr OptionTable kTable{kLowObstacleRows};
  return kTable;
}

Result<void> validate(const LowObstacleOptions& options) {
  return check_options(options);
}

OccupancyGrid without_low_obstacles(OccupancyGrid grid,
                                    const LeafSource& leaves,
                                    const LowObstacleOptions& options) {
  const GridGeometry geometry = grid.geometry();
  const HeightBand band = below_walls(options);
  const std::vector<float> tops = tops_of(geometry, leaves, band);
  const std::vector<float> free_m = free_above(geometry, leaves, band, tops);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const Cell cell{.col = col, .row = row};
      const std::size_t i = geometry.index(cell);
      if (grid.at(cell) < kLeastBlocked || tops[i] == kNoTop) continue;
      const double above_m = band.max_m - static_cast<double>(tops[i]);
      const bool is_looked_over =
          above_m > kSlackM &&
          static_cast<double>(free_m[i]) >= options.min_free_share * above_m - kSlackM;
      if (is_looked_over) grid.set(cell, kFreeCell);
    }
  }
  return grid;
}

}  // namespace hypermap
