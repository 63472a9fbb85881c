// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"

#include <cstdio>

namespace hypermap::app {

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
