// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// `hypermap eval` with a labelled cloud as truth.
#pragma once

#include "command.hpp"
#include "hypermap/io/jobs/cloud_evaluation_job.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

/// The flags that only such a truth has.
struct CloudArguments {
  std::optional<std::string> label_names;
  std::optional<std::string> placement;

  void add_to(CLI::App& command);
  [[nodiscard]] bool any() const { return label_names || placement; }
};

struct CloudReport {
  bool as_json = false;
  std::optional<std::string> csv = std::nullopt;  ///< Folder to write kVoxelCsvName into.
};
inline constexpr const char* kVoxelCsvName = "voxels.csv";

/// Evaluates and prints. `job` lacks what the flags say.
ExitCode run_cloud_eval(CloudEvaluationJob job,
                        const CloudArguments& arguments,
                        const CloudReport& form);

[[nodiscard]] std::string json_text_of(const CloudEvaluationOutcome& outcome);
[[nodiscard]] std::string table_text_of(const CloudEvaluationOutcome& outcome);

}  // namespace hypermap::app
