// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which parts of a matched object a frame had in view.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <span>

namespace hypermap {

/// Tells each object that one detection of `frame` matched which blocks of its points were in view:
/// those that the detection's segment has points in, and those whose centre falls on a pixel with a
/// depth that is not nearer. A part seen by few, since few looked there, is told by that from what
/// few segments took in although others looked (`OccupancyVotes::look`). Box and centroid of the
/// object follow.
///
/// Requires: `association` is of `observations`, which are of `frame`; its merges are applied.
/// Boundary: objects with two detections in the frame are left alone, as if all of them was in
/// view. Cost: O(cells of the matched objects).
void look_at_matched(ObjectMap& objects,
                     const RgbdFrame& frame,
                     std::span<const Observation> observations,
                     const AssociationReport& association,
                     const AssociationOptions& options);

}  // namespace hypermap
