// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// When objects were seen, and what was believed of them at an earlier moment.
///
/// Source: [hypermap] chapter 1 (a hypermap answers about the past, too). Ours: replayed from the
/// observation log, which keeps its first and its newest entries as they were and sums up all, so
/// that not every moment can be told.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/objects/observation_log.hpp"

#include <cstdint>
#include <limits>
#include <optional>

namespace hypermap {

/// Frames from one to before another, as a map counts them: those of a session, or all.
struct FrameRange {
  std::uint64_t first = 0;
  std::uint64_t end = std::numeric_limits<std::uint64_t>::max();

  [[nodiscard]] bool contains(std::uint64_t index) const { return first <= index && index < end; }
  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// From one stamp to another, both included, within some frames; an absent end is open.
struct ObservationSpan {
  std::optional<Stamp> since = std::nullopt;
  std::optional<Stamp> until = std::nullopt;
  FrameRange frames = {};

  [[nodiscard]] bool contains(std::uint64_t frame_index, Stamp stamp) const {
    return frames.contains(frame_index) && (!since || *since <= stamp) &&
           (!until || stamp <= *until);
  }
};

/// A moment while a map was made: all frames before `frames` have come, of those in it the ones up
/// to `stamp`, and none after it. Requires: stamps ascend with the indices of `frames`.
struct MapMoment {
  Stamp stamp = {};
  FrameRange frames = {};

  [[nodiscard]] bool has_come(const ObservationLogEntry& entry) const {
    return entry.frame_index < frames.first ||
           (entry.frame_index < frames.end && entry.stamp <= stamp);
  }
};

/// Whether something was detected. kUnknown: the log has it in its sums alone, if at all.
enum class Sighting : std::uint8_t { kSeen, kNotSeen, kUnknown };

/// Whether an object was detected in a span. Requires: within the frames of the span stamps ascend.
/// Boundary: kUnknown when no kept detection lies in the span, and ones that are no longer kept
/// may: they came after the first entry and before the oldest of the newest. Cost: the entries and
/// sums of the log.
[[nodiscard]] Sighting was_seen_in(const Object& object, const ObservationSpan& span);

/// The stamp of the newest detection. None when there is none, or when it is so old that of it only
/// the frame is kept.
[[nodiscard]] std::optional<Stamp> last_detection(const ObservationLog& log);

/// From which stamp on `log_as_of` tells all: the first entry when each one is kept, else the
/// oldest of the newest. None of an empty log.
[[nodiscard]] std::optional<Stamp> kept_since(const ObservationLog& log);

/// The log as it was when its entries up to a moment had come.
struct PastLog {
  ObservationLog log;
  /// False: entries after the moment and others before it are summed up together, or of those
  /// before it too few are kept to tell how the newest looks went. Then `log` has the first alone.
  bool is_whole = true;
};

/// None when the first entry came later.
/// Boundary: a log of which each entry is kept is replayed, exactly. Of another one whose oldest
/// kept entry had come, the sums are those of now without the newer entries (of floats, within
/// 1e-6 of each) with the frame of their last entry at most that of the moment, and of the newest
/// entries of then those are there that are still kept. A log that does not have its entries in the
/// order of the moment's frames is not whole.
[[nodiscard]] std::optional<PastLog> log_as_of(const ObservationLog& log, const MapMoment& moment);

/// What was believed of the objects of a map at a moment.
struct PastObjects {
  /// Those that had been seen by then and are still in the map, with the logs, existences, numbers
  /// of observations, last detections and named classes of then. Shapes, boxes, points, embeddings,
  /// the prior and under tempering none the classes are those of now.
  ObjectMap objects;
  /// As they are now: those that had been seen by then and whose logs do not tell what was believed
  /// of them, as they are summed up around that moment (`PastLog::is_whole`), or empty.
  ObjectMap unknown;
};

/// Boundary: objects that were removed between then and now are no longer known; those that were
/// merged into others since are one with them. Of objects without a log, `first_seen` says alone
/// whether they had been seen. Cost: linear in objects and the entries of their logs.
[[nodiscard]] PastObjects objects_as_of(const ObjectMap& objects, const MapMoment& moment);

}  // namespace hypermap
