// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A way over supercells, and what there is to know before it is trusted.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/supercells/supercells.hpp"
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// What was asked of the way.
struct WayRequest {
  std::string ends;                     ///< "X,Y,X,Y".
  std::vector<std::string> avoid = {};  ///< Full names of layers.
  bool known = false;                   ///< Through no supercell that is unknown.
};

/// An end of the way that lies in what it is to avoid.
struct AvoidedEnd {
  const char* name = "";  ///< "start", "end".
  std::string place = {};
  int supercell = 0;
  std::string layer = {};        ///< Full name of the first layer that it lies in.
  bool is_of_supercell = false;  ///< Else its cell alone is more probably of the layer than not.
};

/// What was found.
struct Way {
  std::optional<GraphPath> path = {};  ///< None: no way leads there.
  std::vector<std::string> avoided_layers = {};
  std::vector<AvoidedEnd> avoided_ends = {};
  std::vector<int> unknown = {};  ///< Supercells of the way that are, by `unknown_supercells`.
  std::size_t num_avoided_cells =
      0;  ///< In its supercells, more probably of one of those layers than not.
};

/// The shortest way through no supercell that is more probably of a layer to avoid than not, and
/// through no unknown one where that is asked. Its ends are where they are. Requires: supercells
/// and graph are of the stack. Errors: kInvalidArgument for ends that are no four numbers;
/// kNotFound for an end without a cell, or no such layer.
[[nodiscard]] Result<Way> find_way(const GridStack& stack,
                                   const Supercells& supercells,
                                   const TopometricGraph& graph,
                                   const WayRequest& request);

}  // namespace hypermap::app
