// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a session of the shell remembers between its commands, and how it does one.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "shell_map.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct ShellSession {
  explicit ShellSession(ArchiveLimits limits) : map(limits) {}

  ShellMap map;
  std::string frame_id = {};  ///< Of locations and areas, in and out; empty: each layer's own.
  std::vector<std::string> lines = {};  ///< That were typed, the oldest first.
  bool is_ended = false;
};

/// Does what the line says; results go to standard output, notes to standard error. The line is
/// remembered when it has a command.
///
/// Errors: those of the command, whose name stands first in `field`; of a file that it reads or
/// writes `what` names file and place. kInvalidArgument for a line that is no command. The session
/// is then as it was.
[[nodiscard]] Result<void> do_line(ShellSession& session, const std::string& line);

/// One line on standard error, behind what standard output has so far.
void print_note(const std::string& text);

/// Notes that the map of a file (ShellMap::unsaved) is in no archive; nothing where there is none.
void note_unsaved(const std::optional<std::filesystem::path>& unsaved);

}  // namespace hypermap::app
