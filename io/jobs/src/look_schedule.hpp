// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tells frame by frame at which a network looks.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/jobs/look_options.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hypermap {

/// The answers depend on the positions and poses that were asked for before, in their order, and on
/// nothing else.
class LookSchedule {
 public:
  /// Requires: valid options.
  explicit LookSchedule(const LookOptions& options = {}) : options_(options) {}

  /// Whether the network looks at the frame at a position of the input; of keyframes it is one
  /// then. Requires: ascending positions. Cost: with keyframes, a comparison with each of them.
  [[nodiscard]] bool take(std::size_t position, const MapFromCamera& pose);

  /// Whether the answers depend on poses.
  [[nodiscard]] bool needs_poses() const noexcept { return options_.rule == LookRule::kKeyframes; }

 private:
  [[nodiscard]] bool is_known(const MapFromCamera& pose) const;

  LookOptions options_;
  std::vector<MapFromCamera> views_;
  std::optional<std::size_t> last_position_;
};

}  // namespace hypermap
