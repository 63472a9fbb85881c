// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The sessions of a map: the runs that put frames into it, with names and times.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_history.hpp"
#include "hypermap/io/archive/provenance.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// One run.
struct MapSession {
  std::size_t number = 1;  ///< From 1 on, oldest first.
  std::string name = {};   ///< Empty: it has none, and goes by its number.
  std::string input = {};
  std::optional<Stamp> first = std::nullopt;  ///< Stamps of its earliest and latest frame; none in
  std::optional<Stamp> last = std::nullopt;   ///< maps of before they were kept.
  /// Its frames, as the map counts them. None where that was not kept.
  std::optional<FrameRange> frames = std::nullopt;
};

/// Whether it tells of a file that was imported, which is no run: its options are a map `import`.
[[nodiscard]] bool is_import(const Provenance& provenance);

/// Of all runs, oldest first; files that were imported are none. Boundary: the frames of a run that
/// was forgotten (`kMaxRuns`) count to the one after it.
[[nodiscard]] std::vector<MapSession> sessions_of(std::span<const Provenance> provenance);

/// By what name it goes: its own, else its number.
[[nodiscard]] std::string name_of(const MapSession& session);
/// "morning (0.0 .. 33.2 s)", its name alone where its times are not known.
[[nodiscard]] std::string to_string(const MapSession& session);
/// All of them so, between commas.
[[nodiscard]] std::string to_string(std::span<const MapSession> sessions);

/// The session of that name, of equal names the newest; of a number the one without a name that has
/// it. Errors: kNotFound naming those that there are.
[[nodiscard]] Result<MapSession> find_session(std::span<const Provenance> runs,
                                              std::string_view name);

/// Names that several sessions bear, ascending. Of these `find_session` gives the newest alone.
[[nodiscard]] std::vector<std::string> names_of_several(std::span<const MapSession> sessions);

/// The one that a frame is of, as the map counts frames; none where that was not kept.
[[nodiscard]] std::optional<MapSession> session_of_frame(std::span<const MapSession> sessions,
                                                         std::uint64_t frame_index);

/// Whether each session begins after the one before it has ended, as far as the map tells: then a
/// stamp alone says which frames had come.
[[nodiscard]] bool follow_each_other(std::span<const MapSession> sessions);

}  // namespace hypermap
