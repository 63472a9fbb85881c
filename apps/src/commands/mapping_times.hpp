// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `map` writes of its work beside the map: counts and times.
#pragma once

#include "command.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct MappingTimesArguments {
  std::optional<std::string> stats;
  std::optional<std::string> plot;

  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError when a file is one of `read` or `written`, or the other.
  void keep_outputs_apart(const std::vector<std::filesystem::path>& read,
                          const std::vector<std::filesystem::path>& written) const;
  /// Errors: those of check_target.
  [[nodiscard]] Result<void> check_targets() const;
  /// Counts and times as JSON; box plots of the times of a frame, a row for each stage that took
  /// any. `input`: its last part is the plot's title. Errors: kIo; those of draw_box_plot.
  [[nodiscard]] Result<void> write(const MappingReport& report,
                                   const std::filesystem::path& input) const;
};

}  // namespace hypermap::app
