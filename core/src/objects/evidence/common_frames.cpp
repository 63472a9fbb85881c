// SPDX-License-Identifier: BSD-3-Clause
// Frames that two observation logs have in common.
#include "hypermap/core/objects/observation_log.hpp"
#include "objects/evidence/log_frames.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace hypermap {

std::size_t num_common_frames(const ObservationLog& a, const ObservationLog& b) {
  const auto of_a = detected_frames(a.state().newest);
  const auto of_b = detected_frames(b.state().newest);
  return static_cast<std::size_t>(std::ranges::count_if(
      of_a, [&](const FrameOfEntry& frame) { return std::ranges::binary_search(of_b, frame); }));
}

std::optional<std::size_t> num_frames_in_view_together(const ObservationLog& a,
                                                       const ObservationLog& b,
                                                       double least_visible_share) {
  const auto& of_a = a.state().newest;
  const auto& of_b = b.state().newest;
  if (of_a.empty() || of_b.empty()) return std::nullopt;
  // Logs of several runs that count frames anew are in the order of their numbers when merged: what
  // they forgot then need not be the oldest.
  if (!std::ranges::is_sorted(of_a, {}, &ObservationLogEntry::stamp) ||
      !std::ranges::is_sorted(of_b, {}, &ObservationLogEntry::stamp))
    return std::nullopt;
  const auto holds_all_since = [&](const ObservationLogEntry& first) {
    return std::max(of_a.front().stamp, of_b.front().stamp) <= first.stamp &&
           std::max(of_a.front().frame_index, of_b.front().frame_index) <= first.frame_index;
  };
  if (!holds_all_since(*a.state().first) && !holds_all_since(*b.state().first)) return std::nullopt;
  const auto num_missed_beside = [&](const auto& entries, const auto& detected) {
    return std::ranges::count_if(entries, [&](const ObservationLogEntry& entry) {
      return entry.kind == ObservationKind::kMissedDetection &&
             (entry.visibility == Visibility::kAbsent ||
              static_cast<double>(entry.score) >= least_visible_share) &&
             std::ranges::binary_search(detected, frame_of(entry));
    });
  };
  return num_common_frames(a, b) +
         static_cast<std::size_t>(num_missed_beside(of_a, detected_frames(of_b)) +
                                  num_missed_beside(of_b, detected_frames(of_a)));
}

}  // namespace hypermap
