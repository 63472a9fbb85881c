// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The truth about a simulated scene as an archive that maps are compared with.
///
/// Layers: `occupancy` (true geometry in a height band) and `semantic`, whose objects carry the
/// true footprint and the keys below, which a reader that does not know them keeps.
///
///     thing: cup_1                      name in the scene
///     box: [x0, y0, z0, x1, y1, z1]     true bounding box, metres
///     excluded: reason                  only where the object does not count in evaluations
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

/// A band of heights, in which geometry counts as an obstacle for a robot.
struct TrueOccupancyOptions {
  double min_height_m = 0.1;   ///< Lower surfaces (the floor) are no obstacle.
  double max_height_m = 1.8;   ///< Higher surfaces are none either. Range: > min_height_m
  double resolution_m = 0.05;  ///< Edge of a cell. Range: 0.001 .. 10
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const TrueOccupancyOptions& options);
[[nodiscard]] const OptionTable& option_table(const TrueOccupancyOptions& options);

/// Which cells the true surfaces meet. Cells that the camera's way cannot reach over free cells are
/// unknown: the inside of objects, what lies behind walls.
///
/// Errors: those of `validate` and of `OccupancyGrid::create`.
/// Boundary: a point on the edge between two cells belongs as `cell_at` says, so that a wall on an
/// edge occupies one row of cells.
[[nodiscard]] Result<OccupancyGrid> true_occupancy(const FurnishedScene& scene,
                                                   std::span<const CameraWaypoint> way,
                                                   const TrueOccupancyOptions& options = {});

/// Why an object does not count in evaluations; empty when it does.
/// Source: docs/EVALUATION.md, "Match": never 200 depth pixels in any frame, or not nameable.
[[nodiscard]] std::string exclusion(const SimulatedTruth& truth, const SimulatedDetector& detector);

/// The archive `truth.hmap`. `truths` in id order.
/// Errors: those of `true_occupancy` and of the layers.
[[nodiscard]] Result<MapArchive> make_truth(const Simulator& simulator,
                                            const Scene& scene,
                                            std::span<const SimulatedTruth> truths);

}  // namespace hypermap
