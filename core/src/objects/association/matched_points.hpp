// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A frame's depth at the points of an object that it matched.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace hypermap {

/// The position of the only observation of the object in the frame; none when there are more.
[[nodiscard]] std::optional<std::size_t> only_observation_of(ObjectId id,
                                                             const AssociationReport& association);

/// The pixel that the point falls on; may lie outside the image.
[[nodiscard]] Eigen::Vector2i pixel_of(const PixelPoint& at);

/// The depth at the pixel that the point falls on; none outside the image and where none is
/// measured.
[[nodiscard]] std::optional<double> measured_depth_m(const RgbdFrame& frame, const PixelPoint& at);

/// How far the surface at a point may be measured from where a cell of its object is.
[[nodiscard]] double reach_m(double edge_m, double depth_m);

/// Sets the box and the centroid of an object to those of its points, where options ask for that.
void follow_points(Object& object, const AssociationOptions& options);

}  // namespace hypermap
