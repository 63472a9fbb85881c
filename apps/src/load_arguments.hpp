// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands say what reading an archive may cost, and how they end it.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <CLI/App.hpp>

namespace hypermap::app {

struct LoadArguments {
  ArchiveLimits limits;

  void add_to(CLI::App& command);
};

/// Ends a load once SIGINT or SIGTERM came.
[[nodiscard]] StopCheck stop_when_interrupted();

}  // namespace hypermap::app
