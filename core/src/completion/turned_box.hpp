// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Upright boxes that lie as their object does.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/objects/object.hpp"

#include <Eigen/Core>

namespace hypermap {

/// An upright box of any bearing. Its first two axes are horizontal, the longer one first; the
/// third is +z. Unit: metre.
struct TurnedBox {
  Eigen::Matrix3d map_from_box = Eigen::Matrix3d::Identity();  ///< A rotation about z.
  Eigen::Vector3d low = Eigen::Vector3d::Zero();               ///< Along its own axes.
  Eigen::Vector3d high = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d extent() const { return high - low; }
};

/// The footprint of an object, else that of its box.
[[nodiscard]] Ring outline_of(const Object& object);

/// The least rectangle around the object's outline, as high as its box. Of equals the one along the
/// first edge.
/// Cost: the square of the outline's corners.
[[nodiscard]] TurnedBox turned_box_of(const Object& object);

/// The smallest box along the map's axes around it.
[[nodiscard]] Box bounding_box(const TurnedBox& box);

}  // namespace hypermap
