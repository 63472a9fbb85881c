// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What makes a frame unfit to be integrated.
#pragma once

#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "integration/marking/bit_window.hpp"

#include <cstddef>
#include <span>

namespace hypermap {

/// Errors: kInvalidArgument naming `field` when the sensor is not finite or stands outside the
/// volume of the map.
[[nodiscard]] Result<void> check_sensor(const VoxelGrid& grid,
                                        const PointInMap& sensor,
                                        const char* field);

/// Errors: kInvalidArgument when a label names a measurement that is not there, a class above
/// 65,534, or classes that are not sorted by id.
[[nodiscard]] Result<void> check_labels(std::span<const PixelLabels> labels,
                                        std::size_t num_measurements);

/// kLimit: what the window would need and which options to change.
[[nodiscard]] Unexpected window_too_large(const KeyBox& key_bounds,
                                          const IntegrationOptions& options);

}  // namespace hypermap
