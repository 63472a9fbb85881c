// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the program tells what supercells it found.
#pragma once

#include "cells_way.hpp"
#include "hypermap/io/jobs/sensed_stack.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/supercells/supercells.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// What was found, written and asked.
struct CellsAnswer {
  Supercells supercells;
  TopometricGraph graph;
  std::vector<std::filesystem::path> files;
  std::optional<std::vector<int>> of_layer = {};
  std::optional<Way> way = {};  ///< Where one was asked for.
  /// Of the map, as num_cells_without_class, where a way was asked for.
  std::optional<std::size_t> cells_without_class = {};
  std::optional<SensedStackReport> sensed = {};
  std::vector<std::string> without_supercell = {};  ///< Names of layers.
};

/// Layers of which some cell says yes, but no supercell by its mean.
/// Requires: the graph is of this stack.
[[nodiscard]] std::vector<std::string> layers_without_supercell(const GridStack& stack,
                                                                const TopometricGraph& graph);

void print_cells_json(const CellsAnswer& answer);
void print_cells_text(const CellsAnswer& answer);

}  // namespace hypermap::app
