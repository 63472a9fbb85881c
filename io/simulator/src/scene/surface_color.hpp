// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The colour of a material at a point of its shape.
#pragma once

#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <Eigen/Core>

namespace hypermap {

/// Red, green and blue in 0 .. 1 before lighting. `point` and `normal` are in the shape's frame.
[[nodiscard]] Eigen::Vector3f surface_color(const SurfaceMaterial& material,
                                            const Eigen::Vector3f& point,
                                            const Eigen::Vector3f& normal);

/// True when the material shines by itself, so that lamps and shadows do not change it.
[[nodiscard]] inline bool is_glowing(const SurfaceMaterial& material) {
  return material.pattern == SurfacePattern::kScreen;
}

}  // namespace hypermap
