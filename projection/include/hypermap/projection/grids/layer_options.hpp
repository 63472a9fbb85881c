// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the 2D layers of a map are derived from its voxels.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <optional>

namespace hypermap {

struct OptionTable;

struct LayerOptions {
  /// Height of the floor, over which heights of obstacles are, and objects that stand on it. Unit:
  /// metre. Frame: Map. None: as the map
  /// states it, else as it shows it.
  std::optional<double> floor_m = std::nullopt;
  /// Band of heights over the floor in which occupied voxels are obstacles. Unit: metre.
  double min_height_m = 0.1;
  double max_height_m = 1.8;  ///< Above min_height_m.
  /// Least share of the band's height that must have been seen free for a free cell.
  double min_free_share = 0.5;
  /// And at most so much of the band's height, from below, in which nothing free was seen. Unit:
  /// metre.
  double max_unseen_m = 0.2;
  /// Footprints by policy `voxels` lack what was looked through and where other objects stand.
  bool carve_footprints = true;
  /// A stack of evidence for each class is kept beside the other layers.
  bool class_stack = false;
  friend bool operator==(const LayerOptions&, const LayerOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const LayerOptions& options);
[[nodiscard]] const OptionTable& option_table(const LayerOptions& options);

}  // namespace hypermap
