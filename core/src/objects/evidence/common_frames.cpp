// SPDX-License-Identifier: BSD-3-Clause
// Frames that two observation logs have in common.
#include "hypermap/core/objects/observation_log.hpp"
#include "objects/evidence/log_frames.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hypermap {

namespace {

using Frames = std::vector<FrameOfEntry>;

/// Frames of the first that are in the second. Requires: both ascending.
std::size_t num_common(const Frames& a, const Frames& b) {
  return static_cast<std::size_t>(std::ranges::count_if(
      a, [&](const FrameOfEntry& frame) { return std::ranges::binary_search(b, frame); }));
}

/// Each once. Requires: ascending.
Frames unique(Frames frames) {
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// Frames whose entries had the object in view, ascending, each once.
Frames frames_in_view(std::span<const ObservationLogEntry> entries, double least_visible_share) {
  Frames frames;
  for (const ObservationLogEntry& entry : entries) {
    const bool is_in_view = entry.kind == ObservationKind::kDetection ||
                            entry.visibility == Visibility::kAbsent ||
                            static_cast<double>(entry.score) >= least_visible_share;
    if (is_in_view) frames.push_back(frame_of(entry));
  }
  std::ranges::sort(frames);
  return unique(std::move(frames));
}

}  // namespace

std::size_t num_common_frames(const ObservationLog& a, const ObservationLog& b) {
  return num_common(unique(detected_frames(a.state().newest)),
                    unique(detected_frames(b.state().newest)));
}

double DetectionsInView::expected_of_both() const noexcept {
  if (num_frames == 0) return 0.0;
  return static_cast<double>(of_first) * static_cast<double>(of_second) /
         static_cast<double>(num_frames);
}

std::optional<DetectionsInView> detections_in_view(const ObservationLog& a,
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
  const Frames detected_a = unique(detected_frames(of_a));
  const Frames detected_b = unique(detected_frames(of_b));
  const Frames in_view_of_a = frames_in_view(of_a, least_visible_share);
  const Frames in_view_of_b = frames_in_view(of_b, least_visible_share);
  return DetectionsInView{
      .num_frames = num_common(in_view_of_a, in_view_of_b),
      .of_first = num_common(detected_a, in_view_of_b),
      .of_second = num_common(detected_b, in_view_of_a),
      .of_both = num_common(detected_a, detected_b),
      .is_complete = holds_all_since(*a.state().first) || holds_all_since(*b.state().first)};
}

}  // namespace hypermap
