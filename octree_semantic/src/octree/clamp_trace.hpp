// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a voxel's evidence was ever stopped by a clamp, as its log-odds alone tell.
///
/// Ours. Log-odds are a start plus some hits and misses, whole steps each: where few of them
/// explain a value from a clamp and only many from 0, the voxel was at that clamp once, and what
/// was known before is forgotten in it.
#pragma once

#include "hypermap/octree_semantic/octree/sensor_model.hpp"

#include <vector>

namespace hypermap {

/// The answer for each value that a voxel may have.
class ClampTrace {
 public:
  /// Throws std::bad_alloc. Cost: some ten thousand steps.
  explicit ClampTrace(const SensorModel& model);

  /// Boundary: at a clamp it was; of values that as few updates explain from 0, and of those that
  /// 64 hits and 64 misses do not explain (of another sensor model, sums), it was not.
  /// Requires: within the clamps.
  [[nodiscard]] bool was_clamped(MilliLogOdds log_odds) const;

 private:
  MilliLogOdds clamp_min_;
  std::vector<bool> was_clamped_;  ///< From clamp_min on.
};

}  // namespace hypermap
