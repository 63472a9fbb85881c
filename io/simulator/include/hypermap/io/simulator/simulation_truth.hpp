// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The truth about a simulated scene as an archive that maps are compared with.
///
/// Layers: `occupancy` (true geometry in a height band) and `semantic`, whose objects carry the
/// true footprint and the keys below, which a reader that does not know them keeps.
///
///     thing: cup_1                      name in the scene
///     box: [x0, y0, z0, x1, y1, z1]     true bounding box, metres
///     frames_named: 12                  frames in which the detector named it rightly
///     seen_footprint: 0.83              share of the footprint over which its surface was seen
///     stands_on: 4                      number of the object below, or floor; absent: it hangs
///     nameable: false                   only where the detector has no word for the class
///     excluded: reason                  only where the object does not count in evaluations
///
/// Beside them the true surfaces: the triangles of each object and what was seen of them.
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
/// Source: docs/EVALUATION.md, "Visible enough": a class without a word; never 200 depth pixels in
/// any frame; named rightly in fewer than three frames.
[[nodiscard]] std::string exclusion(const SimulatedTruth& truth, const SimulatedDetector& detector);

/// The archive `truth.hmap`. `truths` and `surfaces` in id order, of all objects.
/// Errors: those of `true_occupancy` and of the layers.
[[nodiscard]] Result<MapArchive> make_truth(const Simulator& simulator,
                                            const Scene& scene,
                                            std::span<const SimulatedTruth> truths,
                                            TrueSurfaces surfaces);

}  // namespace hypermap
