// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How what several detectors say becomes one, from the command line.
#pragma once

#include <CLI/App.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct CombinationArguments {
  std::optional<std::string> rule;
  std::vector<std::string> weights;  ///< NAME=WEIGHT each.
  std::optional<std::filesystem::path> combiner;

  void add_to(CLI::App& command);

  /// `stacking.rule`: as it was given, else the one that the other flags need, if any was given.
  [[nodiscard]] std::optional<std::string> rule_text() const;
  /// `stacking.weights`, as a file of options says them. Requires: parsed by `add_to`'s option.
  [[nodiscard]] std::optional<std::string> weights_text() const;
};

}  // namespace hypermap::app
