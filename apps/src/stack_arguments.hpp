// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands say which stack they make of a map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "load_arguments.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct StackArguments {
  std::string file;   ///< Empty where the stack comes from tiles.
  std::string tiles;  ///< Folder; empty where it comes from a map.
  MapStackRequest request;
  std::string rule = "biodds";
  std::vector<std::string> fused;  ///< NAME or NAME=WEIGHT.
  std::vector<std::string> layers;
  std::optional<std::string> area;
  std::optional<double> resolution_m;
  double yaw_deg = 0.0;
  LoadArguments load;

  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError for what is no number, area or layer. To be called before make.
  void finish();
  /// The stack, cut out as asked. Errors: those of loading, stack_of_map or read_tile_map, and
  /// cut_out.
  [[nodiscard]] Result<GridStack> make() const;

 private:
  [[nodiscard]] Result<GridStack> uncut_stack() const;
};

/// The full name of a layer that may be named without its parent.
[[nodiscard]] std::string full_layer_name(const GridStackOptions& options, const std::string& name);

}  // namespace hypermap::app
