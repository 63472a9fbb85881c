// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the detections of a frame show of its depth.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <span>
#include <vector>

namespace hypermap {

struct FrameObservations {
  std::vector<Observation> observations;  ///< Of the detections that the depth confirms, in order.
  std::vector<const Detection*> without_segment;  ///< Those that it does not confirm, in order.
  std::vector<const Detection*> not_begun;        ///< Those that came too late, in order.
};

/// Throws: std::bad_alloc.
[[nodiscard]] FrameObservations observe(const RgbdFrame& frame,
                                        std::span<const Detection> detections,
                                        const SemanticMapperOptions& options,
                                        const MayBegin& may_begin);

}  // namespace hypermap
