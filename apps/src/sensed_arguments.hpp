// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands say which frames are fused into a stack, and how.
#pragma once

#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/sensed_stack.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct SensedArguments {
  DatasetArguments dataset;
  std::vector<std::string> detections;
  std::vector<std::string> sensors = {"depth"};  ///< NAME or NAME=WEIGHT.
  std::optional<std::string> reference;
  SensedStackJob job;

  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError for what is no sensor. To be called before fuse_into.
  void finish();
  /// Fuses the frames, when there are to be any. Errors: those of fuse_frames.
  [[nodiscard]] Result<std::optional<SensedStackReport>> fuse_into(GridStack& stack,
                                                                   const MapArchive& map) const;
};

/// Prints frames that could not be read as warnings; says how to end for them.
[[nodiscard]] ExitCode report_skipped(const std::optional<SensedStackReport>& sensed);

}  // namespace hypermap::app
