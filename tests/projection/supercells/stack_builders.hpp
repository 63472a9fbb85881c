// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Stacks for tests of supercells, and what connected means, written out.
#pragma once

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {

inline GridGeometry cells_of(int cols, int rows) {
  return {.resolution_m = 0.1, .cols = cols, .rows = rows};
}

/// With layers "/ism/0", "/ism/1" ...; `probability(layer, cell)` of each.
template <class ProbabilityOf>
GridStack stack_from(const GridGeometry& geometry,
                     int num_layers,
                     const ProbabilityOf& probability) {
  GridStack stack = GridStack::create(geometry).value();
  for (int layer = 0; layer < num_layers; ++layer) {
    std::vector<double> p;
    for (int row = 0; row < geometry.rows; ++row) {
      for (int col = 0; col < geometry.cols; ++col) p.push_back(probability(layer, Cell{col, row}));
    }
    const LogOddsGrid grid = LogOddsGrid::of_probabilities(geometry, p).value();
    (void)stack
        .fuse({.layer = "/ism/" + std::to_string(layer), .grid = grid},
              Eigen::Matrix3d(Eigen::Matrix3d::Identity()))
        .value();
  }
  return stack;
}

/// Any probability in any cell, a fifth of them unknown.
inline GridStack random_stack(const GridGeometry& geometry, int num_layers, std::uint64_t seed) {
  CounterRng random(seed, 13);
  return stack_from(geometry, num_layers, [&](int /*layer*/, Cell /*cell*/) {
    const double p = random.uniform();
    return random.chance(0.2) ? 0.5 : p;
  });
}

/// In how many parts, connected over edges, the cells of one label lie.
inline int num_parts(const GridGeometry& geometry,
                     const std::vector<std::int32_t>& labels,
                     int of) {
  std::vector<bool> seen(labels.size(), false);
  int parts = 0;
  for (std::size_t start = 0; start < labels.size(); ++start) {
    if (labels[start] != of || seen[start]) continue;
    ++parts;
    std::vector<std::size_t> waiting{start};
    seen[start] = true;
    while (!waiting.empty()) {
      const std::size_t here = waiting.back();
      waiting.pop_back();
      const int col = static_cast<int>(here % static_cast<std::size_t>(geometry.cols));
      const int row = static_cast<int>(here / static_cast<std::size_t>(geometry.cols));
      for (const Cell next : {Cell{col + 1, row}, {col - 1, row}, {col, row + 1}, {col, row - 1}}) {
        if (!geometry.contains(next)) continue;
        const std::size_t i = geometry.index(next);
        if (labels[i] != of || seen[i]) continue;
        seen[i] = true;
        waiting.push_back(i);
      }
    }
  }
  return parts;
}

}  // namespace hypermap::test
