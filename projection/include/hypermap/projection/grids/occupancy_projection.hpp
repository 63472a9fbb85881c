// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which parts of the floor are blocked or free, seen from the 3D map.
///
/// Ours, in the sense of [hypermap] 3.3.3 (an occupancy layer beside the others). Rule for the
/// column above a cell, within the height band:
/// - occupied, when any occupied leaf lies in it;
/// - else free, when at least `min_free_share` of its volume was seen free, down to `max_unseen_m`
///   over the band's lower end (below it a suitcase may stand that nobody saw), and it hides no
///   level: where all but a height of at most 0.2 m was seen free and beside it, within 0.15 m,
///   something thin was measured at that height, the top of a table goes on;
/// - else unknown. Unknown is not free: what was not observed may hold a wall.
/// Boundary: a cell larger than leaves, or turned, was seen at a height where any part of it was.
/// No level is hidden among leaves or cells of more than 0.15 m; in a band of more than 61 leaves
/// levels are of two, or four and so on, and one that was seen in part counts as seen.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <functional>
#include <optional>

namespace hypermap {

struct OptionTable;

/// From above `min_m` to below `max_m`. Frame: Map. A leaf that only touches it from outside is not
/// in it.
struct HeightBand {
  double min_m = 0.1;  ///< Above the floor's own voxels, whatever their height within 10 cm.
  double max_m = 1.8;  ///< A person's height.
};

/// A band of heights over the floor, as heights of the map.
[[nodiscard]] constexpr HeightBand over(const MapFloor& floor, const HeightBand& band) noexcept {
  return {.min_m = floor.height_m + band.min_m, .max_m = floor.height_m + band.max_m};
}

struct OccupancyProjectionOptions {
  /// Edge of a cell; 0: that of the smallest leaf in the band. Unit: metre.
  double resolution_m = 0.0;
  /// Least share of the band's height that must have been seen free, in (0, 1].
  double min_free_share = 0.5;
  /// The lowest of what was seen free lies at most so high over the band's lower end. Unit: metre.
  double max_unseen_m = 0.2;
  /// The grid to fill, turned or not; none: the smallest one around the band's leaves, unturned,
  /// its cells aligned with the map's origin.
  std::optional<GridGeometry> geometry = std::nullopt;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const HeightBand& band,
                                    const OccupancyProjectionOptions& options);
[[nodiscard]] const OptionTable& option_table(const OccupancyProjectionOptions& options);

/// Boundary: a map without leaves in the band gives a grid without cells (or all of
/// `options.geometry` unknown). Errors: kInvalidArgument; kLimit when the grid would be too large.
/// Cost: two passes over the leaves, 25 bytes a cell besides the grid, and 32 for each one beside
/// the edge of something thin.
[[nodiscard]] Result<OccupancyGrid> project_occupancy(
    const LeafSource& leaves,
    const HeightBand& band = {},
    const OccupancyProjectionOptions& options = {});

/// The grid that project_occupancy would fill.
[[nodiscard]] Result<GridGeometry> projection_geometry(
    const LeafSource& leaves,
    const HeightBand& band = {},
    const OccupancyProjectionOptions& options = {});

/// Called with a cell below a leaf, the share of the cell that the leaf covers, in (0, 1], and the
/// height of the leaf within the band.
using ColumnVisitor = std::function<void(Cell, double covered, double height_m)>;

/// Visits the cells of `geometry` below the part of a leaf that lies in the band; none when no part
/// does.
void for_each_column(const GridGeometry& geometry,
                     const HeightBand& band,
                     const LeafSample& leaf,
                     const ColumnVisitor& visit);

}  // namespace hypermap
