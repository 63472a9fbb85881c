// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of the map one frame is compared with.
///
/// Source: [smap] figures 3.22 and 3.23, steps 1, C.2.2 and C.1. The other policies limit
/// themselves.
#pragma once

#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "hypermap/core/objects/object_scope.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

namespace hypermap {

/// Objects that an observation of the frame may show: for association policy smap those within
/// `association.graph_layers` of the sensor's vertex and in the active cone, up to the ranges of
/// the segmentation.
/// Requires: these are set; `places` outlives the scope and does not change.
/// Boundary: a topological map without vertices limits nothing. It is as the frames before left it:
/// a step of this one that makes a vertex counts from the next frame on.
[[nodiscard]] ObjectScope scope_of_candidates(const RgbdFrame& frame,
                                              const TopologicalMap& places,
                                              const ObjectPipelineOptions& options);

/// Objects whose absence the frame may show: the same for visibility policy panels, within
/// `absence.graph_layers`.
[[nodiscard]] ObjectScope scope_of_absences(const RgbdFrame& frame,
                                            const TopologicalMap& places,
                                            const ObjectPipelineOptions& options);

}  // namespace hypermap
