// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The parts of a scene as shapes to draw, in their colours.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"
#include "scene_colors.hpp"
#include "scene_content.hpp"
#include "scene_painter.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace hypermap {

/// Faces that look towards the eye, in the colours of their classes; unlabelled ones are tinted by
/// height. Errors: those of exposed_faces.
[[nodiscard]] Result<std::vector<PaintedFace>> paint_voxels(const VisibleVoxels& voxels,
                                                            const ClassColors& colors,
                                                            const SnapshotCamera& camera);

/// The twelve edges of each box.
[[nodiscard]] std::vector<PaintedLine> paint_boxes(std::span<const SnapshotObject> objects,
                                                   const ClassColors& colors);
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

}  // namespace hypermap
