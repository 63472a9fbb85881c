// SPDX-License-Identifier: BSD-3-Clause
#include "shell_session.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "shell_commands.hpp"
#include "shell_words.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

/// How a command is typed.
std::string usage_of(const ShellCommand& command) {
  std::string text(command.name);
  if (!command.arguments.empty()) text += " " + std::string(command.arguments);
  return text;
}

Result<void> run_words(ShellSession& session, ShellArguments words) {
  HYPERMAP_ASSIGN_OR_RETURN(const ShellCommand* command, find_shell_command(words.front()));
  words.erase(words.begin());
  const auto done = [&]() -> Result<void> {
    if (words.size() < command->min_words || words.size() > command->max_words) {
      return fail(ErrorCode::kInvalidArgument,
                  "is typed as \"" + usage_of(*command) + "\", has " +
                      count_text(words.size(), "word") + " behind its name");
    }
    return guarded(
        ErrorCode::kUnavailable, "the command", [&] { return command->run(session, words); });
  }();
  if (done) return {};
  const Error& error = done.error();
  const std::string name(command->name);
  // Line and member that an error names are those of a file, not of what is typed.
  if (!error.file.empty()) return fail(error.code, to_string(error), name);
  return fail(error.code, error.what, name + (error.field.empty() ? "" : ": " + error.field));
}

constexpr const char* kPlacesHelp =
    "A LOCATION is X,Y or X,Y,Z or POINT (X Y), an AREA \"x y,x y,x y\" or POLYGON ((x y, x y, x "
    "y)), in metres. Words with\nblanks stand in quotes; # begins a comment. A STRING may be an "
    "alias, a super-class, a prefix (chair*) or an\nexpression (/chair|sofa/).\n";

void print_all_help() {
  std::size_t width = 0;
  for (const ShellCommand& command : shell_commands())
    width = std::max(width, usage_of(command).size());
  for (const ShellCommand& command : shell_commands()) {
    std::string usage = usage_of(command);
    usage.resize(width, ' ');
    std::printf("%s  %s\n", usage.c_str(), std::string(command.help).c_str());
  }
  std::printf("\n%s", kPlacesHelp);
}

}  // namespace

Result<void> do_line(ShellSession& session, const std::string& line) {
  HYPERMAP_ASSIGN_OR_RETURN(ShellArguments words, split_shell_line(line));
  if (words.empty()) return {};
  session.lines.push_back(line);
  return run_words(session, std::move(words));
}

void print_note(const std::string& text) {
  std::fflush(stdout);
  std::fprintf(stderr, "note: %s\n", text.c_str());
}

void note_unsaved(const std::optional<std::filesystem::path>& unsaved) {
  if (!unsaved) return;
  print_note("the map of " + printable(unsaved->string(), 500) + " was saved to no archive");
}

Result<void> do_help(ShellSession& /*session*/, const ShellArguments& words) {
  if (words.empty()) {
    print_all_help();
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const ShellCommand* command, find_shell_command(words.front()));
  std::printf("%s\n  %s\n", usage_of(*command).c_str(), std::string(command->help).c_str());
  return {};
}

Result<void> do_history(ShellSession& session, const ShellArguments& words) {
  std::size_t count = session.lines.size();
  if (!words.empty()) {
    const auto asked = parse_unsigned(words.front());
    if (!asked) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be a whole number, is '" + printable(words.front()) + "'",
                  "COUNT");
    }
    count = std::min<std::uint64_t>(count, *asked);
  }
  for (std::size_t i = session.lines.size() - count; i < session.lines.size(); ++i)
    std::printf("%5zu  %s\n", i + 1, printable(session.lines[i], 4096).c_str());
  return {};
}

Result<void> do_exit(ShellSession& session, const ShellArguments& /*words*/) {
  session.is_ended = true;
  return {};
}

}  // namespace hypermap::app
