// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map as a semantic occupancy grid: a layer of a stack for each class, from its voxels.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/class_stack.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

/// An occupancy layer of the map that is fused as a sensor's grid.
struct FusedLayer {
  std::string name;
  double weight = 1.0;  ///< As SensorGrid::weight.
};

struct MapStackRequest {
  /// Its band is over the map's floor; the frame of its options is not asked, but the map's.
  ClassStackRequest of_classes = {};
  std::vector<FusedLayer> fused = {};  ///< In this order, after the classes.
  ResamplingOptions resampling = {};   ///< Of fused layers.
};

/// A stack on the cells of the map's class grids: class_stack of its shown voxels (`shown_leaves`)
/// in the largest region of the map, and the layers asked for, by their frames.
///
/// Errors: kNotFound when no voxel, or none of the classes asked for, lies in the band and no layer
/// is fused (of "--class" or of "--min-height, --max-height", as the reason is), a class is not
/// known or a layer not there;
/// kUnsupported for a layer that is no occupancy grid; those of GridStack::fuse.
[[nodiscard]] Result<GridStack> stack_of_map(const MapArchive& archive,
                                             const MapStackRequest& request);

/// Cells of the map's class grids above which voxels are occupied in the band, none of which bears
/// a class (walls, where these have none): every class of stack_of_map counts them as free.
/// Errors: kNotFound when the map has no voxels; those of projection_geometry. Cost: two passes
/// over the leaves.
[[nodiscard]] Result<std::size_t> num_cells_without_class(const MapArchive& archive,
                                                          const HeightBand& band_over_floor);

/// The grid as map_server reads it from the maps of write_stack_maps: occupied, free or unknown.
/// Boundary: maps of a turned stack are turned back, which this is not. Errors: kOutOfMemory.
[[nodiscard]] Result<OccupancyGrid> trinary_cells(const LogOddsGrid& grid);

/// Whether the maps of a stack, as write_stack_maps leaves them, lie in a folder; not where there
/// is no folder. Errors: kIo when it cannot be looked at.
[[nodiscard]] Result<bool> holds_stack_maps(const std::filesystem::path& folder);

/// Whether maps of a stack may be written to a folder: it is not there, empty, or holds what
/// write_stack_maps wrote and nothing else but such maps.
/// Errors: kInvalidArgument naming what would be lost; kIo when it cannot be looked at.
[[nodiscard]] Result<void> check_stack_folder(const std::filesystem::path& folder);

/// The layers and their combined map as map_server maps in a folder: `<layer>.yaml`,
/// `combined.yaml` and the images that they name, trinary by map_server's usual thresholds 0.65 and
/// 0.196. The maps of a turned stack are turned back and padded. Returns the files that were
/// written. The folder is replaced as a whole, so that it never holds maps of two stacks.
///
/// Errors: those of check_stack_folder; kIo; kLimit for a turned geometry that is too large without
/// its turn. Then the folder is as it was.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_stack_maps(
    const GridStack& stack, const LogOddsGrid& combined, const std::filesystem::path& folder);

}  // namespace hypermap
