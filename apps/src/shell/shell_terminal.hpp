// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A session of the shell at a terminal: prompt, editing, completion, history.
#pragma once

#include "command.hpp"
#include "shell_session.hpp"

namespace hypermap::app {

/// Whether somebody types and reads: standard input and output are terminals.
[[nodiscard]] bool is_at_terminal();

/// Does what is typed until `exit`, Ctrl-D or SIGTERM. Errors are told and end nothing; Ctrl-C
/// drops the line that is typed, or ends a load. Lines are kept in history_file().
///
/// kDone, or kSystem when there is no line editor or standard output is gone.
[[nodiscard]] ExitCode run_shell_terminal(ShellSession& session);

}  // namespace hypermap::app
