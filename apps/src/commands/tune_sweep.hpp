// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// `tune --sweep`: maps with each combination of values, compared with truths.
#pragma once

#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <CLI/App.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {

struct SweepArguments {
  std::vector<std::string> axes;  ///< OPTION=a,b,c each; empty: no sweep was asked for.
  std::string scene = "laboratory";
  std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5};
  int num_frames = 200;
  std::string places;                   ///< As `map --places`, of maps that no axis says other of.
  std::optional<std::string> combiner;  ///< As `map --combiner`, likewise.
  std::optional<std::string> truth;     ///< Of the dataset at --input, which is then swept.
  std::vector<std::pair<std::string, std::string>> also;  ///< Datasets with their truths.
  bool json = false;

  [[nodiscard]] bool is_asked() const { return !axes.empty(); }
  /// Without `--sweep`, what belongs to it is refused.
  void add_to(CLI::App& command);
  /// Throws: CLI::ValidationError for a seed that is named twice, and for a file that no map of the
  /// sweep would use. Requires: axes that parse_sweep_axis takes.
  void keep_to_rules() const;
};

/// Sweeps over the given sequences, or over a scene at each of the seeds, which is simulated in a
/// folder for temporary files that goes at the end. Prints a table, or JSON.
[[nodiscard]] ExitCode sweep(const SweepArguments& arguments,
                             const DatasetArguments& dataset,
                             const std::vector<std::string>& detections,
                             const MapOptions& options,
                             const std::string& progress_when);

}  // namespace hypermap::app
