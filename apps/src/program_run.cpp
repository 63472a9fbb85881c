// SPDX-License-Identifier: BSD-3-Clause
#include "program_run.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "interruption.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

namespace hypermap::app {
namespace {

/// Whether standard output is a pipe whose reader has gone.
bool is_reader_gone() {
  pollfd standard_output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return ::poll(&standard_output, 1, 0) == 1 && (standard_output.revents & POLLERR) != 0;
}

/// Output that could not be written (a full disk, a closed pipe) is a loss, never success. A reader
/// that has gone knows of its loss: to it nothing is said.
ExitCode flushed(ExitCode code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  if (is_reader_gone()) return ExitCode::kSystem;
  std::fprintf(stderr, "hypermap: standard output: could not be written\n");
  return ExitCode::kSystem;
}

constexpr int kUsageStatus = static_cast<int>(ExitCode::kUsage);

/// What may be said in the first place of a command line: commands, then the options of the one
/// that was chosen.
std::vector<std::string> known_words(const CLI::App& program) {
  std::vector<std::string> words;
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) {
    for (const CLI::App* command : program.get_subcommands({}))
      words.push_back(command->get_name());
  }
  for (const CLI::App* app : {&program, chosen.empty() ? &program : chosen.front()}) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    }
  }
  return words;
}

/// The words of the command line that nobody knows, as they were written, and what the first may
/// have been meant to be.
std::string unknown_words(const CLI::App& program) {
  const std::vector<std::string> unknown = program.remaining(true);
  std::string text;
  for (const std::string& word : unknown) text += (text.empty() ? "" : " ") + printable(word);
  if (unknown.empty()) return text;
  const std::string first = unknown.front().substr(0, unknown.front().find('='));
  return text + did_you_mean(first, known_words(program));
}

/// What the chosen command needs beside its options and was not given, each with what it is.
std::string missing_words(const CLI::App& program) {
  std::string text;
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) return text;
  for (const CLI::Option* option : chosen.front()->get_options()) {
    const bool is_missing =
        option->get_positional() && option->get_required() && option->count() == 0;
    if (!is_missing) continue;
    text +=
        (text.empty() ? "" : ", ") + option->get_name() + " (" + option->get_description() + ")";
  }
  return text;
}

/// An empty word is no value but of a title: a variable of a script that was not set.
/// Throws CLI::ValidationError.
void refuse_empty_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const auto& values = option->results();
    const bool is_empty = std::find(values.begin(), values.end(), "") != values.end();
    if (is_empty && option->get_name() != "--title") {
      throw CLI::ValidationError(option->get_name(), "is empty");
    }
  }
}

ExitCode parse_and_run(CommandLine& command_line, int argc, const char* const* argv) {
  CLI::App& program = command_line.program;
  try {
    program.parse(argc, argv);
    for (const CLI::App* command : program.get_subcommands()) refuse_empty_values(*command);
  } catch (const CLI::ParseError& error) {
    const bool is_help_requested = error.get_exit_code() == 0;
    // What is missing may only be misspelt.
    const std::string unknown = is_help_requested ? "" : unknown_words(program);
    const bool lacks_word = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const std::string missing = lacks_word ? missing_words(program) : "";
    if (!unknown.empty()) {
      program.exit(CLI::ParseError("unknown: " + unknown, kUsageStatus));
    } else if (!missing.empty()) {
      program.exit(CLI::ParseError("missing: " + missing, kUsageStatus));
    } else {
      program.exit(error);
    }
    return is_help_requested ? flushed(ExitCode::kDone) : ExitCode::kUsage;
  }
  return flushed(command_line.action());
}

/// What the shell says of a program that a signal ended; the work itself was ended in good order.
int status_of(ExitCode code) {
  const int signal = interrupting_signal();
  return signal == 0 ? static_cast<int>(code) : 128 + signal;
}

}  // namespace

void prepare_process() {
  // A reader that goes away and a limit on file sizes are reported by errors, not by signals.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  watch_interruptions();
}

int run_program(MessagePort* ranks, int argc, const char* const* argv) try {
  CommandLine command_line(ranks);
  return status_of(parse_and_run(command_line, argc, argv));
} catch (const std::bad_alloc&) {
  std::fprintf(stderr, "hypermap: out of memory\n");
  return static_cast<int>(ExitCode::kSystem);
} catch (const std::system_error& error) {  // no thread, no file
  std::fprintf(stderr, "hypermap: %s\n", error.what());
  return static_cast<int>(ExitCode::kSystem);
} catch (const std::exception& error) {
  std::fprintf(stderr, "hypermap: internal error: %s\n", error.what());
  return static_cast<int>(ExitCode::kInternal);
}

}  // namespace hypermap::app
