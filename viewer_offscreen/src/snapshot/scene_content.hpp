// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What of a scene is drawn: the shapes, the points to frame, and what is written.
#pragma once

#include "annotations.hpp"
#include "hypermap/viewer_offscreen/rendering/sky_light.hpp"
#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"
#include "scene_painter.hpp"

#include <Eigen/Core>

#include <limits>
#include <span>
#include <vector>

namespace hypermap {

/// The scene's classes, and those that only its 2D layer names.
[[nodiscard]] ClassRegistry classes_shown(const SnapshotScene& scene);

/// The layers asked for, or those that suit the view and exist in the scene.
[[nodiscard]] SnapshotLayers layers_shown(const SnapshotScene& scene,
                                          const SnapshotOptions& options);

/// The voxels that stay after looking into rooms, where the floor is, and what shades them.
struct ShownVoxels {
  std::vector<OccupiedVoxel> voxels;
  double floor_m = 0.0;
  double cut_m = std::numeric_limits<double>::infinity();  ///< Over the floor.
  std::size_t num_occupied = 0;                            ///< Before cutting.
  SkyLight light{{}};  ///< Of all below the ceiling, walls included.
};
[[nodiscard]] ShownVoxels voxels_shown(const SnapshotScene& scene, const SnapshotOptions& options);

/// The smallest part of a grid that holds all known cells; the grid itself when none is known.
[[nodiscard]] OccupancyGrid known_part(const OccupancyGrid& grid);

/// Points that must fall into the picture. Of many voxels the outermost thousandth on each side is
/// left out, so that a few stray ones do not make all others small.
[[nodiscard]] std::vector<Eigen::Vector3d> points_to_frame(const SnapshotScene& scene,
                                                           const SnapshotLayers& layers,
                                                           const ShownVoxels& voxels,
                                                           const SnapshotView& view);

/// Faces that look towards the eye, in the colours of their classes; unlabelled ones are tinted by
/// height. Errors: those of bare_faces.
[[nodiscard]] Result<std::vector<PaintedFace>> paint_voxels(const ShownVoxels& voxels,
                                                            const SnapshotCamera& camera);

/// The twelve edges of each box.
[[nodiscard]] std::vector<PaintedLine> paint_boxes(std::span<const SnapshotObject> objects);
/// The camera's way.
[[nodiscard]] std::vector<PaintedLine> paint_trajectory(std::span<const Eigen::Vector3d> points);
/// The lines of an overlay.
[[nodiscard]] std::vector<PaintedLine> paint_overlay_lines(std::span<const DrawnLine> lines,
                                                           double height_m);
/// The rings of a polygon.
[[nodiscard]] std::vector<PaintedLine> paint_outline(const Polygon& polygon,
                                                     double height_m,
                                                     Paint paint);
/// Lines of a round number of metres on the floor, through all of the plan that is framed.
[[nodiscard]] std::vector<PaintedLine> paint_metric_grid(std::span<const Eigen::Vector3d> framed,
                                                         double height_m,
                                                         double pixels_per_m);

/// Title, legend and labels. `registry` is that of classes_shown.
[[nodiscard]] Annotations annotations_of(const SnapshotScene& scene,
                                         const SnapshotOptions& options,
                                         const SnapshotLayers& layers,
                                         const ShownVoxels& voxels,
                                         const ClassRegistry& registry);

/// Colour of a thing of a class; grey without one.
[[nodiscard]] Rgb8 color_of(const std::optional<ClassId>& class_id);

}  // namespace hypermap
