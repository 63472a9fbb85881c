// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options that `tune` segments with.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// What the command line says of them.
struct TuneOptions {
  std::string preset = "default";
  std::optional<std::string> config;
  std::optional<std::string> policy;
  std::optional<double> angle_deg;
  std::optional<std::string> curvature;
  std::optional<std::string> leaf_size_m;
  std::optional<std::string> max_range_m;
  std::vector<std::string> settings;  ///< NAME=VALUE each.
  std::vector<std::string> without;   ///< Steps that are left out.
  bool no_outliers = false;
  bool no_clusters = false;

  void add_to(CLI::App& command);
};

/// Preset, file, policy with the values of its source, single flags, then what is left out; ranges
/// that follow the map's are filled in.
/// Errors: those of read_options and with_option; kInvalidArgument naming the flag for what the
/// policy does not have.
[[nodiscard]] Result<MapOptions> map_options_of(const TuneOptions& arguments);

}  // namespace hypermap::app
