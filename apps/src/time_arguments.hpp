// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Times and sessions on command lines.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_history.hpp"
#include "hypermap/io/codec/time_text.hpp"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

/// For an option that names a new session.
[[nodiscard]] CLI::Validator name_of_session();

/// Of which time a map is asked.
struct AskedTime {
  std::optional<WrittenTime> since = std::nullopt;
  std::optional<WrittenTime> until = std::nullopt;
  std::optional<WrittenTime> as_of = std::nullopt;
  std::optional<std::string> session = std::nullopt;
};

/// Flags that ask for another time than now.
struct TimeArguments {
  std::optional<std::string> since;
  std::optional<std::string> until;
  std::optional<std::string> as_of;
  std::optional<std::string> session;

  void add_to(CLI::App& command);
  [[nodiscard]] bool is_asked() const { return since || until || as_of || session; }
  /// Errors: kInvalidArgument naming the flag: no time, --as-of with --since or --until, --since
  /// after --until.
  [[nodiscard]] Result<AskedTime> time() const;
};

/// The map at that time: as it was believed with `as_of`, else what was seen.
/// Errors: those of map_as_of and map_seen_in; kInvalidArgument naming the member whose date cannot
/// be one of the map's clock.
[[nodiscard]] Result<PastMap> past_of(const MapArchive& archive, const AskedTime& asked);

/// "as of 12.5 s", "from 3.0 s on in session morning".
[[nodiscard]] std::string text_of(const AskedTime& asked);

/// "12.5 s", with the date where the stamp counts from 1970.
[[nodiscard]] std::string dated_text(Stamp stamp);

}  // namespace hypermap::app
