// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The commands of the shell: those of [hypermap] table 2, and what else a map answers.
///
/// Source: [hypermap] 3.3.1, table 2.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "shell_session.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// What a word of a command names; by it words are completed.
enum class ShellWordKind { kNone, kFile, kLayer, kClass, kId, kFrame, kCommand };

/// Words behind a command's name.
using ShellArguments = std::vector<std::string>;

struct ShellCommand {
  std::string_view name;
  std::string_view arguments;  ///< As help shows them.
  std::string_view help;       ///< One line.
  std::size_t min_words = 0;   ///< Behind the name.
  std::size_t max_words = 0;
  std::array<ShellWordKind, 2> kinds = {ShellWordKind::kNone, ShellWordKind::kNone};
  /// Requires: as many words as the command takes.
  Result<void> (*run)(ShellSession& session, const ShellArguments& words) = nullptr;
};

/// In the order in which help lists them.
[[nodiscard]] std::span<const ShellCommand> shell_commands();

/// The command of that name, upper and lower case alike. Errors: kInvalidArgument with the nearest.
[[nodiscard]] Result<const ShellCommand*> find_shell_command(std::string_view name);

/// The words from `first` on with a blank between two: a location, an area or a name.
[[nodiscard]] std::string joined_words(const ShellArguments& words, std::size_t first);

// Of the session and its files; each does what help says of the command of its name.
Result<void> do_help(ShellSession& session, const ShellArguments& words);
Result<void> do_load(ShellSession& session, const ShellArguments& words);
Result<void> do_load_config(ShellSession& session, const ShellArguments& words);
Result<void> do_save(ShellSession& session, const ShellArguments& words);
Result<void> do_clear(ShellSession& session, const ShellArguments& words);
Result<void> do_frame(ShellSession& session, const ShellArguments& words);
Result<void> do_history(ShellSession& session, const ShellArguments& words);
Result<void> do_exit(ShellSession& session, const ShellArguments& words);
// Of layers.
Result<void> do_layers(ShellSession& session, const ShellArguments& words);
Result<void> do_layer_count(ShellSession& session, const ShellArguments& words);
Result<void> do_republish(ShellSession& session, const ShellArguments& words);
Result<void> do_string(ShellSession& session, const ShellArguments& words);
Result<void> do_strings(ShellSession& session, const ShellArguments& words);
Result<void> do_coords(ShellSession& session, const ShellArguments& words);
Result<void> do_coords_area(ShellSession& session, const ShellArguments& words);
Result<void> do_int(ShellSession& session, const ShellArguments& words);
Result<void> do_ints(ShellSession& session, const ShellArguments& words);
Result<void> do_int_coords(ShellSession& session, const ShellArguments& words);
Result<void> do_int_coords_area(ShellSession& session, const ShellArguments& words);
// Of the 3D map's objects.
Result<void> do_objects(ShellSession& session, const ShellArguments& words);
Result<void> do_nearest(ShellSession& session, const ShellArguments& words);
Result<void> do_why(ShellSession& session, const ShellArguments& words);
Result<void> do_why_not(ShellSession& session, const ShellArguments& words);

}  // namespace hypermap::app
