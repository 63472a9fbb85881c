// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"

#include <cstdio>

namespace hypermap::app {
namespace {

constexpr ExitStatus kExitStatuses[] = {
    {"0", "done"},
    {"1", "done with findings: a difference, a warning, a repair made while reading"},
    {"2",
     "content refused, limits included; any finding under --strict; more than --max-skipped frames "
     "lost, none of them by the system"},
    {"3",
     "the system: reading or writing failed (of frames: more than --max-skipped lost, one of them "
     "so), no memory, no EGL"},
    {"4", "the command line is wrong"},
    {"5", "a fault of the program"},
    {"130, 143",
     "SIGINT or SIGTERM came: long commands ended after the frame in hand, or while an archive was "
     "loaded, and wrote nothing but checkpoints asked for; others finished"},
};

}  // namespace

std::span<const ExitStatus> exit_statuses() {
  return kExitStatuses;
}

ExitCode exit_code_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::kIo:
    case ErrorCode::kOutOfMemory:
    case ErrorCode::kUnavailable:
    case ErrorCode::kInterrupted:
      return ExitCode::kSystem;
    case ErrorCode::kInvalidArgument:
    case ErrorCode::kNotFound:
    case ErrorCode::kMalformedFile:
    case ErrorCode::kUnsupported:
    case ErrorCode::kLimit:
      break;
  }
  return ExitCode::kRefused;
}

Error of_option(Error error, const char* option) {
  error.field = option;
  return error;
}

ExitCode report(const Error& error) {
  std::fprintf(stderr, "hypermap: %s\n", to_string(error).c_str());
  return exit_code_of(error);
}

ExitCode report(const Finding& finding) {
  const bool is_error = finding.severity == Severity::kError;
  std::fprintf(
      stderr, "%s: %s\n", is_error ? "error" : "warning", to_string(finding.error).c_str());
  return is_error ? ExitCode::kRefused : ExitCode::kFindings;
}

void show_examples(CLI::App& command, std::initializer_list<const char*> lines) {
  std::string text = "Examples:";
  for (const char* line : lines) text.append("\n  ").append(line);
  command.footer(text);
}

}  // namespace hypermap::app
