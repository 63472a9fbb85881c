// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a robot comes to objects: the options of `query --nearest --free-space`.
#pragma once

#include "hypermap/projection/grids/free_space.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace hypermap::app {

struct ApproachArguments {
  bool free_space = false;
  std::optional<double> robot_radius_m;
  std::optional<double> reach_m;

  void add_to(CLI::App& command);
  /// Options of a robot without a way to find for it.
  [[nodiscard]] bool is_incomplete() const { return !free_space && (robot_radius_m || reach_m); }
  [[nodiscard]] ApproachOptions options() const;
};

}  // namespace hypermap::app
