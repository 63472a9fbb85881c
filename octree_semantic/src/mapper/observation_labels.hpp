// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From associated observations to the labels of what they measured.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// One for each observation, in their order: its object, class vector and pixels.
/// Requires: `association` is of these observations.
[[nodiscard]] std::vector<PixelLabels> observation_labels(std::vector<Observation> observations,
                                                          const AssociationReport& association);

/// Those that an object was found for, in their order.
/// Requires: `association` is of these observations.
[[nodiscard]] std::vector<DetectedObject> detected_objects(
    std::span<const Observation> observations, const AssociationReport& association);

/// The objects that the frame showed, ascending, each once.
[[nodiscard]] std::vector<ObjectId> ids_of_detected(const AssociationReport& association);

}  // namespace hypermap
