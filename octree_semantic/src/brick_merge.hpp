// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Adds one frame's evidence to the occupancy of a brick.
#pragma once

#include "hypermap/octree_semantic/sensor_model.hpp"

#include <cstdint>

namespace hypermap {

/// The parts of a brick that hold occupancy: 8 words of bits, 512 log-odds.
struct BrickOccupancy {
  std::uint64_t* known;
  std::uint64_t* occupied;
  MilliLogOdds* log_odds;
};

/// Adds the model's hit to the voxels of `hit` and its miss to those of `passed` that are not hit,
/// and clamps. Returns whether any voxel became occupied or ceased to be.
///
/// Source: A. Hornung et al., "OctoMap", Eq. (4), clamped by Eq. (5) of the same paper.
/// Requires: `hit` and `passed` of 8 words each.
bool add_evidence(const BrickOccupancy& brick,
                  const std::uint64_t* hit,
                  const std::uint64_t* passed,
                  const SensorModel& model) noexcept;

}  // namespace hypermap
