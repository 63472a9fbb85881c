// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// SIGINT and SIGTERM as a request that long jobs poll, so that none is cut off in the middle.
#pragma once

namespace hypermap::app {

/// From now on the first SIGINT or SIGTERM is noted; a second one of its kind ends the program at
/// once.
void watch_interruptions();

/// The signal that was noted; 0: none.
[[nodiscard]] int interrupting_signal();

/// As if none had come; signals are watched as before.
void forget_interruption();

}  // namespace hypermap::app
