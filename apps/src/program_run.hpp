// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A run of the program, from its words to its exit status.
#pragma once

#include "command_line.hpp"
#include "hypermap/io/jobs/rank_crew.hpp"

namespace hypermap::app {

/// Which signals are errors, and which are noted.
void prepare_process();

/// The status of a run, whatever it throws. `ranks`: of a program that is one of several
/// (CommandLine).
[[nodiscard]] int run_program(MessagePort* ranks, int argc, const char* const* argv);

}  // namespace hypermap::app
