// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The frames of an observation log's entries.
#pragma once

#include "hypermap/core/objects/observation_log.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {

/// Number and stamp: runs that were appended may count their frames anew.
using FrameOfEntry = std::pair<std::uint64_t, Stamp>;

[[nodiscard]] inline FrameOfEntry frame_of(const ObservationLogEntry& entry) {
  return {entry.frame_index, entry.stamp};
}

/// Frames of the entries that are detections, ascending.
[[nodiscard]] inline std::vector<FrameOfEntry> detected_frames(
    std::span<const ObservationLogEntry> entries) {
  std::vector<FrameOfEntry> frames;
  frames.reserve(entries.size());
  for (const ObservationLogEntry& entry : entries) {
    if (entry.kind == ObservationKind::kDetection) frames.push_back(frame_of(entry));
  }
  std::ranges::sort(frames);
  return frames;
}

}  // namespace hypermap
