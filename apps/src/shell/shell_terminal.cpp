// SPDX-License-Identifier: BSD-3-Clause
#include "shell_terminal.hpp"

#include "interruption.hpp"
#include "line_editor.hpp"
#include "shell_completion.hpp"
#include "shell_history.hpp"
#include "shell_script.hpp"

#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

/// Whether the session goes on after what came while a line was typed or done: Ctrl-C ends one line
/// alone.
bool goes_on_after_signal() {
  if (interrupting_signal() != SIGINT) return interrupting_signal() == 0;
  forget_interruption();
  return true;
}

/// Does one line and says what went wrong.
void do_typed_line(ShellSession& session, LineEditor& editor, const std::string& line) {
  const std::size_t num_lines = session.lines.size();
  const auto done = do_line(session, line);
  if (session.lines.size() > num_lines) editor.remember(line);
  std::fflush(stdout);
  tell_findings(session);
  if (!done) std::fprintf(stderr, "%s\n", to_string(done.error()).c_str());
}

/// Lines that can be read again next time; that they cannot be kept ends no session.
void keep_history(std::span<const std::string> lines) {
  const auto file = history_file();
  if (!file || lines.empty()) return;
  const auto kept = append_history(*file, lines);
  if (!kept) print_note("no history: " + to_string(kept.error()));
}

}  // namespace

bool is_at_terminal() {
  return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1;
}

ExitCode run_shell_terminal(ShellSession& session) {
  auto editor = LineEditor::create("hypermap> ", [&session](std::string_view line_to_cursor) {
    return complete(session, line_to_cursor);
  });
  if (!editor)
    return report(Error{.code = ErrorCode::kUnavailable, .what = "no line editor can be had"});
  if (const auto file = history_file()) session.lines = read_history(*file);
  for (const std::string& line : session.lines) editor->remember(line);
  const std::size_t num_old_lines = session.lines.size();
  std::fprintf(stderr, "help lists the commands, Tab completes, exit ends\n");
  while (!session.is_ended && std::ferror(stdout) == 0) {
    const LineEditor::Line line = editor->next();
    if (line.state != LineEditor::State::kLine) std::printf("\n");
    if (line.state == LineEditor::State::kEnd) break;
    if (line.state == LineEditor::State::kLine) do_typed_line(session, *editor, line.text);
    if (!goes_on_after_signal()) break;
  }
  keep_history(std::span(session.lines).subspan(num_old_lines));
  note_unsaved(session.map.unsaved());
  return ExitCode::kDone;
}

}  // namespace hypermap::app
