// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects that simulated rooms are furnished with, as parametric shapes.
///
/// Source: the kinds of objects in [hypermap] figures 10 and 11 and in the rooms of [smap].
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <string_view>
#include <vector>

namespace hypermap {

/// What a shape is made from.
struct FurnitureSpec {
  std::string_view shape;  ///< One of `furniture_shapes()`.
  /// Extent along x (front to back), y (left to right), z. Unit: metre. Zero: the shape's usual
  /// size.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  /// Main colour and a second one; missing ones are the shape's usual colours.
  std::vector<Rgb8> colors;
};

/// Names of all shapes, in alphabetical order.
[[nodiscard]] std::span<const std::string_view> furniture_shapes();

/// The shape in its own frame: it stands on z = 0, the middle of its ground plan is the origin and
/// it faces +x (who sits on a chair looks along +x; a screen shines towards +x).
///
/// Errors: kNotFound when there is no such shape (those that there are are listed);
/// kInvalidArgument when a size is neither 0 nor in 0.01 .. 20 m.
[[nodiscard]] Result<TriangleMesh> build_furniture(const FurnitureSpec& spec);

}  // namespace hypermap
