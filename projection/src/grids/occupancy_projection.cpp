// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include "grids/hidden_levels.hpp"
#include "hypermap/core/base/option_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// A leaf's edge on a cell's edge up to rounding does not reach into the next cell.
constexpr double kSlackCells = 1e-6;
/// Rounding of a height decides nothing.
constexpr double kHeightSlackM = 1e-6;

constexpr OptionRow kProjectionRows[] = {
    option::number<&OccupancyProjectionOptions::resolution_m>(
        "resolution_m",
        option::at_least(0),
        {.unit = "m", .effect = "Edge of a cell; 0: that of the smallest leaf in the band."}),
    option::number<&OccupancyProjectionOptions::min_free_share>(
        "min_free_share",
        option::above(0, 1),
        {.effect = "A cell is free when so much of its height was seen free."}),
    option::number<&OccupancyProjectionOptions::max_unseen_m>(
        "max_unseen_m",
        {0, 1000},
        {.unit = "m",
         .effect = "And the lowest of it lies at most so high over the band's lower end."}),
};

Result<void> check_geometry(const OccupancyProjectionOptions& options) {
  return options.geometry ? validate(*options.geometry) : Result<void>{};
}

double height_within(const HeightBand& band, const LeafSample& leaf) {
  const double low = std::max(leaf.centre_in_map.z() - leaf.edge_m / 2, band.min_m);
  const double high = std::min(leaf.centre_in_map.z() + leaf.edge_m / 2, band.max_m);
  return high - low > kSlackCells * leaf.edge_m ? high - low : 0.0;
}

/// Length that a cell of an axis shares with [from, to], all in cells.
double overlap(int cell, double from, double to) {
  return std::min(to, cell + 1.0) - std::max(from, static_cast<double>(cell));
}

int first_cell(double from) {
  return static_cast<int>(std::floor(from + kSlackCells));
}
int last_cell(double to) {
  return static_cast<int>(std::ceil(to - kSlackCells)) - 1;
}

/// The unturned case, without polygons.
void visit_straight(const GridGeometry& geometry,
                    const LeafSample& leaf,
                    double height_m,
                    const ColumnVisitor& visit) {
  const double half = leaf.edge_m / geometry.resolution_m / 2;
  const Eigen::Vector2d middle = to_cells(geometry, leaf.centre_in_map.head<2>());
  const Eigen::Vector2d from = (middle.array() - half).max(0.0);
  const Eigen::Vector2d to(std::min(middle.x() + half, static_cast<double>(geometry.cols)),
                           std::min(middle.y() + half, static_cast<double>(geometry.rows)));
  if (!(from.x() < to.x() && from.y() < to.y())) return;
  for (int row = first_cell(from.y()); row <= last_cell(to.y()); ++row) {
    for (int col = first_cell(from.x()); col <= last_cell(to.x()); ++col) {
      const double covered = overlap(col, from.x(), to.x()) * overlap(row, from.y(), to.y());
      visit({col, row}, std::min(covered, 1.0), height_m);
    }
  }
}

Polygon square_of(const LeafSample& leaf) {
  const double half = leaf.edge_m / 2;
  const Eigen::Vector2d c = leaf.centre_in_map.head<2>();
  return {.outer = {c + Eigen::Vector2d(-half, -half),
                    c + Eigen::Vector2d(half, -half),
                    c + Eigen::Vector2d(half, half),
                    c + Eigen::Vector2d(-half, half)},
          .holes = {}};
}

/// What the leaves of a band take up on the floor.
struct Extent {
  Eigen::Vector2d min = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d max = Eigen::Vector2d::Constant(-1e300);
  double smallest_edge_m = 0.0;
};

Extent extent_of(const LeafSource& leaves, const HeightBand& band) {
  Extent extent;
  leaves([&](const LeafSample& leaf) {
    if (height_within(band, leaf) <= 0.0) return;
    const Eigen::Vector2d centre = leaf.centre_in_map.head<2>();
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(leaf.edge_m / 2);
    extent.min = extent.min.cwiseMin(centre - half);
    extent.max = extent.max.cwiseMax(centre + half);
    const bool is_smaller = extent.smallest_edge_m == 0.0 || leaf.edge_m < extent.smallest_edge_m;
    if (is_smaller) extent.smallest_edge_m = leaf.edge_m;
  });
  return extent;
}

/// Cells that start at multiples of the resolution, as the octree's voxels do.
Result<GridGeometry> around(const Extent& extent, double resolution_m) {
  const Eigen::Vector2d from = (extent.min / resolution_m).array() + kSlackCells;
  const Eigen::Vector2d to = (extent.max / resolution_m).array() - kSlackCells;
  const Eigen::Vector2d first(std::floor(from.x()), std::floor(from.y()));
  const Eigen::Vector2d size(std::ceil(to.x()) - first.x(), std::ceil(to.y()) - first.y());
  if (!(size.maxCoeff() < 1e6)) {
    return fail(ErrorCode::kLimit, "the map is too wide for this resolution", "resolution_m");
  }
  const GridGeometry geometry{.resolution_m = resolution_m,
                              .origin = first * resolution_m,
                              .cols = static_cast<int>(size.x()),
                              .rows = static_cast<int>(size.y())};
  HYPERMAP_TRY(validate(geometry));
  return geometry;
}

/// The grid that is asked for, else one around the extent; without cells where that is empty.
Result<GridGeometry> geometry_for(const Extent& extent, const OccupancyProjectionOptions& options) {
  if (options.geometry) return *options.geometry;
  if (extent.smallest_edge_m == 0.0) return GridGeometry{};
  return around(extent, options.resolution_m > 0.0 ? options.resolution_m : extent.smallest_edge_m);
}

struct Column {
  float free_m = 0.0F;  ///< Mean height that was seen free.
  bool is_seen_low = false;
  bool is_occupied = false;
};

struct Columns {
  std::vector<Column> cells;
  std::vector<bool> hides_level;
};

/// Of the band, over each cell; low is what begins at `low_m` at most. Requires: leaf_edge_m > 0,
/// of the smallest leaves in the band.
Columns columns_of(const LeafSource& leaves,
                   const HeightBand& band,
                   const GridGeometry& geometry,
                   double leaf_edge_m,
                   double low_m) {
  Columns columns{.cells = std::vector<Column>(geometry.num_cells()), .hides_level = {}};
  HiddenLevels levels(geometry, band, leaf_edge_m);
  leaves([&](const LeafSample& leaf) {
    const std::uint64_t of_leaf = levels.levels_of(leaf);
    const bool is_low = leaf.centre_in_map.z() - leaf.edge_m / 2 <= low_m;
    for_each_column(geometry, band, leaf, [&](Cell cell, double covered, double height_m) {
      Column& column = columns.cells[geometry.index(cell)];
      levels.add(cell, leaf, of_leaf);
      if (leaf.occupied) {
        column.is_occupied = true;
      } else {
        column.free_m += static_cast<float>(covered * height_m);
        column.is_seen_low = column.is_seen_low || is_low;
      }
    });
  });
  columns.hides_level = std::move(levels).take_hidden_cells();
  return columns;
}

}  // namespace

const OptionTable& option_table(const OccupancyProjectionOptions&) {
  static constexpr OptionTable kTable{kProjectionRows, kRule<check_geometry>};
  return kTable;
}

Result<void> validate(const HeightBand& band, const OccupancyProjectionOptions& options) {
  if (!(band.min_m < band.max_m) || !std::isfinite(band.max_m - band.min_m)) {
    return fail(ErrorCode::kInvalidArgument, "min must be below max, both finite", "height_band");
  }
  return check_options(options);
}

void for_each_column(const GridGeometry& geometry,
                     const HeightBand& band,
                     const LeafSample& leaf,
                     const ColumnVisitor& visit) {
  const double height_m = height_within(band, leaf);
  if (height_m <= 0.0) return;
  if (geometry.yaw_rad == 0.0) return visit_straight(geometry, leaf, height_m, visit);
  for_each_covered_cell(geometry, square_of(leaf), [&](Cell cell, double covered) {
    visit(cell, covered, height_m);
  });
}

Result<GridGeometry> projection_geometry(const LeafSource& leaves,
                                         const HeightBand& band,
                                         const OccupancyProjectionOptions& options) {
  HYPERMAP_TRY(validate(band, options));
  if (options.geometry) return *options.geometry;
  return geometry_for(extent_of(leaves, band), options);
}

Result<OccupancyGrid> project_occupancy(const LeafSource& leaves,
                                        const HeightBand& band,
                                        const OccupancyProjectionOptions& options) {
  HYPERMAP_TRY(validate(band, options));
  const Extent extent = extent_of(leaves, band);
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_for(extent, options));
  if (extent.smallest_edge_m == 0.0) return OccupancyGrid::create(geometry, kUnknownCell);
  try {
    const double low_m = band.min_m + options.max_unseen_m + kHeightSlackM;
    const Columns columns = columns_of(leaves, band, geometry, extent.smallest_edge_m, low_m);
    // Rounding of sums must not make a column miss a share that it has exactly.
    const double needed_m = options.min_free_share * (band.max_m - band.min_m) * (1.0 - 1e-5);
    std::vector<std::int8_t> cells(geometry.num_cells(), kUnknownCell);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Column& column = columns.cells[i];
      const bool is_free = static_cast<double>(column.free_m) >= needed_m && column.is_seen_low &&
                           !columns.hides_level[i];
      cells[i] = column.is_occupied ? kOccupiedCell : is_free ? kFreeCell : kUnknownCell;
    }
    return OccupancyGrid::create(geometry, std::move(cells));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the grid", "resolution_m");
  }
}

}  // namespace hypermap
