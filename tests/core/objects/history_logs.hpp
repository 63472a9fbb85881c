// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Observation logs second by second.
#pragma once

#include "hypermap/core/objects/object_history.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap::testing_support {

/// A detection of class 1 in a frame; frames are a second apart.
inline ObservationLogEntry detected_in(std::uint64_t frame, std::int64_t second) {
  return {.frame_index = frame,
          .stamp = Stamp{second * 1'000'000'000},
          .class_id = ClassId{1},
          .score = 0.5F,
          .bearing_rad = 0.1F,
          .distance_m = 2.0F,
          .effect = 0.25F};
}

inline ObservationLogEntry detected_at(std::int64_t second) {
  return detected_in(static_cast<std::uint64_t>(second), second);
}

/// The camera looks through its place.
inline ObservationLogEntry absent_at(std::int64_t second) {
  ObservationLogEntry entry = detected_at(second);
  entry.kind = ObservationKind::kMissedDetection;
  entry.visibility = Visibility::kAbsent;
  entry.effect = -1.0F;
  entry.score = 0.0F;
  return entry;
}

inline Stamp stamp_s(std::int64_t second) {
  return Stamp{second * 1'000'000'000};
}

inline MapMoment moment_s(std::int64_t second) {
  return {.stamp = stamp_s(second)};
}

/// An object of that log, as association keeps it.
inline Object object_with_log(const std::vector<ObservationLogEntry>& entries) {
  Object object;
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{1}, Probability(0.9)}},
                        Probability(0.5));
  object.box = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  object.first_seen = entries.front().stamp;
  object.last_seen = entries.front().stamp;
  for (const ObservationLogEntry& entry : entries) {
    object.observation_log.add(entry);
    object.existence += LogOdds(static_cast<double>(entry.effect));
    if (entry.kind != ObservationKind::kDetection) continue;
    ++object.num_observations;
    object.first_seen = std::min(object.first_seen, entry.stamp);
    object.last_seen = std::max(object.last_seen, entry.stamp);
  }
  return object;
}

/// Detections at each second of [0, count).
inline std::vector<ObservationLogEntry> every_second(std::int64_t count) {
  std::vector<ObservationLogEntry> entries;
  entries.reserve(static_cast<std::size_t>(count));
  for (std::int64_t second = 0; second < count; ++second) entries.push_back(detected_at(second));
  return entries;
}

}  // namespace hypermap::testing_support
