// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A session of the shell whose lines come from a file or a pipe.
#pragma once

#include "command.hpp"
#include "shell_session.hpp"

namespace hypermap::app {

/// Does the lines of standard input to its end, to `exit` or to a signal; without prompt or echo,
/// the answer to a line written out before the next one is read. An error is one line on standard
/// error with the number of the line, and the next line is done unless `stops_at_errors`.
///
/// The worst code of all lines: kFindings for what was noticed while a map was read.
[[nodiscard]] ExitCode run_shell_script(ShellSession& session, bool stops_at_errors);

/// Prints what was noticed while maps were read. Returns kFindings when there was something.
ExitCode tell_findings(ShellSession& session);

}  // namespace hypermap::app
