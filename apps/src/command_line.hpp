// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The program's command line as a whole: its commands and their options.
#pragma once

#include "command.hpp"
#include "hypermap/io/jobs/rank_crew.hpp"

#include <CLI/App.hpp>

namespace hypermap::app {

/// Ready to parse; then `action` is what was asked for. Stays where it is, as parsed options are
/// written into it.
struct CommandLine {
  /// `ranks`: what carries messages to the other ranks where this program is one of several; else
  /// none.
  explicit CommandLine(MessagePort* ranks = nullptr);

  CLI::App program;
  CommonOptions common;
  Action action;
};

}  // namespace hypermap::app
