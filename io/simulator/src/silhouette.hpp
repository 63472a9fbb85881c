// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of an object is unhidden in a view.
#pragma once

#include "embree_scene.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/io/simulator/scene_renderer.hpp"
#include "hypermap/io/simulator/triangle_mesh.hpp"
#include "ray_grid.hpp"

namespace hypermap {

/// A shape by itself: its mesh, the same for rays, and where both are.
struct LoneShape {
  const TriangleMesh& mesh;
  const EmbreeScene& alone;
  Eigen::Isometry3d map_from_mesh;
  Eigen::Isometry3f mesh_from_map;
};

/// Pixels of `id` in the view over the grid points that the shape would fill alone, 0 .. 1. The
/// grid reaches to twice the image's size. Requires: the view was rendered along `rays`.
[[nodiscard]] double unhidden_share(const LoneShape& shape,
                                    const InstanceImage& instances,
                                    ObjectId id,
                                    const RayGrid& rays);

}  // namespace hypermap
