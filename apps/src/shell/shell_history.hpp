// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The lines of earlier sessions at a terminal.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap::app {

/// As many lines are kept, the newest; longer ones than this are not.
inline constexpr std::size_t kMaxHistoryLines = 1000;
inline constexpr std::size_t kMaxHistoryLineBytes = 4096;

/// `$XDG_STATE_HOME/hypermap/history`, else `~/.local/state/hypermap/history`; none where neither
/// variable holds an absolute path.
[[nodiscard]] std::optional<std::filesystem::path> history_file();

/// The lines of the file, the oldest first; lines that no session can have typed are left out.
/// Boundary: none when the file is absent, too long or cannot be read: a history is a convenience.
[[nodiscard]] std::vector<std::string> read_history(const std::filesystem::path& file);

/// Puts the lines behind those that the file has now, and makes its folder where it is not there.
/// Errors: those of write_file_atomically.
[[nodiscard]] Result<void> append_history(const std::filesystem::path& file,
                                          std::span<const std::string> lines);

}  // namespace hypermap::app
