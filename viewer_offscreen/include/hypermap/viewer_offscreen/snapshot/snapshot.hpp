// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An image of a map: voxels by class, objects, 2D layers, with legend and scale.
#pragma once

#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/layer_drawing.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_options.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// An object as it is drawn: a box in the colour of its class, and what is written beside it.
struct SnapshotObject {
  Box box;
  std::optional<ClassId> class_id = std::nullopt;  ///< None: grey.
  std::string label = {};                          ///< Empty: no label.
};

/// What layers of any type draw besides: on the floor, in the order of the layers.
struct SnapshotOverlay {
  std::vector<DrawnCells> cells = {};
  std::vector<DrawnLine> lines = {};
  std::vector<DrawnText> texts = {};

  [[nodiscard]] bool empty() const { return cells.empty() && lines.empty() && texts.empty(); }
};

/// What there is to show. Frame: `frame_id`; the 2D layers lie in its plane. Every part may be
/// absent.
///
/// Requires: what `leaves` looks at outlives the scene.
struct SnapshotScene {
  std::string title = {};
  std::string frame_id = "map";
  LeafSource leaves = {};
  /// Over which heights are, and at which grids and shapes lie. None: where the leaves show it.
  std::optional<double> floor_m = std::nullopt;
  std::vector<SnapshotObject> objects = {};
  std::optional<OccupancyGrid> occupancy = std::nullopt;
  std::vector<SemanticObject> semantic =
      {};  ///< In the colour of `name`, labelled with it and `id`.
  SnapshotOverlay overlay = {};
  std::vector<Eigen::Vector3d> trajectory_in_map = {};
  ClassRegistry classes = {};
  ClassPalette palette = {};
  std::size_t num_tentative = 0;           ///< Objects of the map that are not drawn: not sure yet.
  std::vector<std::string> left_out = {};  ///< What could not be brought into the frame, and why.
};

/// Draws the scene. The same scene and options give the same image on one machine and driver.
///
/// Boundary: a scene without anything to show gives an empty image that says so.
/// Errors: those of validate(SnapshotOptions); those of EglContext::create; kUnavailable when no
/// font is found (the places are named); kLimit for more than 2^25 visible voxel faces;
/// kOutOfMemory.
/// Cost: one walk over the leaves, then linear in the occupied ones.
/// Threads: makes its own OpenGL context on the calling thread, for the duration of the call.
[[nodiscard]] Result<ColorImage> render_snapshot(const SnapshotScene& scene,
                                                 const SnapshotOptions& options = {});

}  // namespace hypermap
