// SPDX-License-Identifier: BSD-3-Clause
#include "shell_script.hpp"

#include "interruption.hpp"
#include "shell_input.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hypermap::app {
namespace {

Result<void> do_script_line(ShellSession& session, const ShellInput::Line& line) {
  if (!line.is_too_long) return do_line(session, line.text);
  return fail(ErrorCode::kLimit, "is longer than " + std::to_string(kMaxShellLineBytes) + " bytes");
}

/// The line's error, with its place in standard input.
ExitCode report_line(Error error, int number) {
  error.file = "standard input";
  error.line = number;
  return report(error);
}

}  // namespace

ExitCode tell_findings(ShellSession& session) {
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : session.map.take_findings())
    worst = std::max(worst, report(finding));
  return worst;
}

ExitCode run_shell_script(ShellSession& session, bool stops_at_errors) {
  ShellInput input(STDIN_FILENO);
  ExitCode worst = ExitCode::kDone;
  for (int number = 1; !session.is_ended && interrupting_signal() == 0; ++number) {
    auto line = input.next_line();
    if (!line) return report_line(std::move(line).error(), number);
    if (line->state != ShellInputState::kByte) break;
    const auto done = do_script_line(session, *line);
    const bool is_written = std::fflush(stdout) == 0;
    worst = std::max(worst, tell_findings(session));
    if (!done) worst = std::max(worst, report_line(done.error(), number));
    if ((!done && stops_at_errors) || !is_written) break;
  }
  note_unsaved(session.map.unsaved());
  return worst;
}

}  // namespace hypermap::app
