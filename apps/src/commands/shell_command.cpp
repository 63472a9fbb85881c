// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "load_arguments.hpp"
#include "shell/shell_script.hpp"
#include "shell/shell_session.hpp"
#include "shell/shell_terminal.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace hypermap::app {
namespace {

struct ShellCommandArguments {
  std::optional<std::string> file;
  bool stops_at_errors = false;
  LoadArguments load;
};

ExitCode run_shell_command(const ShellCommandArguments& arguments) {
  ShellSession session(arguments.load.limits);
  if (arguments.file) {
    if (const auto loaded = session.map.load(*arguments.file); !loaded)
      return report(loaded.error());
  }
  const ExitCode found = tell_findings(session);
  if (is_at_terminal()) return run_shell_terminal(session);
  return std::max(found, run_shell_script(session, arguments.stops_at_errors));
}

}  // namespace

void add_shell_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<ShellCommandArguments>();
  CLI::App& command = *program.add_subcommand(
      "shell", "Load, ask and save maps by commands that are typed, or read from standard input");
  command.add_option("file", arguments->file, "archive or configuration to begin with");
  command.add_flag("--stop-at-errors",
                   arguments->stops_at_errors,
                   "of lines from a file or pipe: none is done after one that fails");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap shell lab.hmap",
                 "echo 'getString semantic 1.5,2' | hypermap shell lab.hmap",
                 "hypermap shell < questions.txt"});
  command.callback(
      [arguments, &action] { action = [arguments] { return run_shell_command(*arguments); }; });
}

}  // namespace hypermap::app
