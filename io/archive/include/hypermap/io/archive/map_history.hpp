// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A map as it was believed at an earlier moment, and what of it was seen in a span of time.
///
/// Source: [hypermap] chapter 1 (the definition's temporal queries). From the observation logs of
/// the objects (object_history.hpp) and the sessions of the map (map_sessions.hpp).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/core/objects/object_history.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace hypermap {

/// The part of a map that is kept through time: its objects, and the layer `semantic`. All else is
/// left out: occupancy, octrees, class grids and layers of other names say what is believed now.
/// It answers questions, and must not be saved in the place of the map.
struct PastMap {
  MapArchive map;
  /// Objects, with their shapes, that would be among those of `map` if it could be told, as they
  /// are now: their logs are summed up around that time.
  MapArchive unknown;
  /// Names and confidences are those of now: the map's rules sum them up otherwise than the logs
  /// do (tempering none; confidence weighted, multiplied).
  bool has_classes_of_now = false;
  /// Of a span: objects that were seen in it and are not confirmed now, tentative or gone.
  std::size_t num_unconfirmed = 0;
};

/// The objects as they were believed when all frames up to `stamp` had come (`objects_as_of`), and
/// the layer `semantic` of those that `rules` confirmed then, with their names and confidences of
/// then. An object's shape is that of now: the layer's where that still shows it, else its points'.
/// With a session, the frames of all sessions before it had come, and its own up to `stamp`.
///
/// Boundary: an object that would be confirmed, but for a stronger one in its place of which
/// nothing can be told, is unknown like that one. Before the first frame nothing is there. Errors:
/// those of find_session, project_footprints; kInvalidArgument naming `session` when none is given
/// and the sessions overlap in time or do not ascend; kUnsupported naming it when the map does not
/// tell which frames are of the session, and naming `objects` when it has none; kOutOfMemory.
[[nodiscard]] Result<PastMap> map_as_of(const MapArchive& archive,
                                        Stamp stamp,
                                        const std::optional<std::string>& session = std::nullopt,
                                        const ConfirmationOptions& rules = {});

/// From one stamp to another, both included, in one session or in any of them.
struct AskedSpan {
  std::optional<Stamp> since = std::nullopt;
  std::optional<Stamp> until = std::nullopt;
  std::optional<std::string> session = std::nullopt;
};

/// The confirmed objects that were detected in a span of time, as they are believed now, and their
/// shapes in the layer `semantic`, if the map has one.
/// Boundary: objects that were removed since are no longer known.
/// Errors: those of find_session; kInvalidArgument naming `since` when it is after `until`;
/// kUnsupported as map_as_of; kOutOfMemory.
[[nodiscard]] Result<PastMap> map_seen_in(const MapArchive& archive, const AskedSpan& span);

/// From the first frame to the last, as the runs say; of a map of before they did, from the first
/// to the last detection of an object. None when nothing says it.
struct MapTimes {
  Stamp first = {};
  Stamp last = {};
  friend bool operator==(const MapTimes&, const MapTimes&) = default;
};
[[nodiscard]] std::optional<MapTimes> times_of(const MapArchive& archive);

}  // namespace hypermap
