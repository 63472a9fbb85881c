// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a frame shows outside a detection's box and mask, or on surfaces that run on beyond them,
/// is not part of what was detected.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <span>

namespace hypermap {

/// Takes a vote from each cell of a matched object that `frame` shows outside the box of the
/// object's detection, or amid the background of its segment, and returns how many cells lost one.
/// Box and centroid of the object follow.
///
/// A cell is shown where its centre falls on a pixel whose depth is that of the cell, within one
/// and a half edges and three standard deviations of the sensor's noise (axial_noise_m). Objects
/// with two detections in the frame are left alone: each of the boxes may show a part. Source:
/// ours.
///
/// Requires: `association` is of `observations`, which are of `frame`; its merges are applied.
/// Boundary: cells behind the camera, outside the image or hidden say nothing; no object loses its
/// last cell.
/// Cost: O(cells of the matched objects), and copies of those that lose votes.
std::size_t carve_by_boxes(ObjectMap& objects,
                           const RgbdFrame& frame,
                           std::span<const Observation> observations,
                           const AssociationReport& association,
                           const AssociationOptions& options);

}  // namespace hypermap
