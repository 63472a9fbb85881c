// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What of a scene is drawn: its layers, voxels and classes, the points to frame, and what is
/// written.
#pragma once

#include "annotations.hpp"
#include "hypermap/viewer_offscreen/rendering/sky_light.hpp"
#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"
#include "scene_colors.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace hypermap {

/// The scene's classes, and those that only its 2D layer names.
[[nodiscard]] ClassRegistry drawn_classes(const SnapshotScene& scene);

/// The layers asked for, or those that suit the view and exist in the scene.
[[nodiscard]] SnapshotLayers drawn_layers(const SnapshotScene& scene,
                                          const SnapshotOptions& options);

/// The voxels that stay after looking into rooms, where the floor is, and what shades them.
struct VisibleVoxels {
  std::vector<OccupiedVoxel> voxels;
  double floor_m = 0.0;
  double cut_m = std::numeric_limits<double>::infinity();  ///< Over the floor.
  std::size_t num_occupied = 0;                            ///< Before cutting.
  std::size_t num_too_high = 0;                            ///< Cut above `cut_m`.
  std::size_t num_near_walls = 0;                          ///< Cut before the room.
  SkyLight light{{}};  ///< Of all below the ceiling, walls included.
};
[[nodiscard]] VisibleVoxels visible_voxels(const SnapshotScene& scene,
                                           const SnapshotOptions& options);

/// The smallest part of a grid that holds all known cells; the grid itself when none is known.
[[nodiscard]] OccupancyGrid known_part(const OccupancyGrid& grid);

/// Points that must fall into the image. Of many voxels the outermost thousandth on each side is
/// left out, so that a few stray ones do not make all others small.
[[nodiscard]] std::vector<Eigen::Vector3d> points_to_frame(const SnapshotScene& scene,
                                                           const SnapshotLayers& layers,
                                                           const VisibleVoxels& voxels,
                                                           const SnapshotView& view);

/// Points of all that is drawn, close enough to show what it covers of the page.
[[nodiscard]] std::vector<Eigen::Vector3d> points_drawn(const SnapshotScene& scene,
                                                        const SnapshotLayers& layers,
                                                        const VisibleVoxels& voxels);

/// Title, legend and labels. `registry` is that of drawn_classes.
[[nodiscard]] Annotations annotations_of(const SnapshotScene& scene,
                                         const SnapshotOptions& options,
                                         const SnapshotLayers& layers,
                                         const VisibleVoxels& voxels,
                                         const ClassRegistry& registry,
                                         const ClassColors& colors);

}  // namespace hypermap
