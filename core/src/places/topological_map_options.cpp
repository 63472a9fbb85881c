// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/places/topological_map.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kTopologicalMapRows[] = {
    option::number<&TopologicalMapOptions::vertex_distance_m>(
        "vertex_distance_m",
        {0.1, 100},
        {.unit = "m",
         .source = "[smap] 3.5.1, V_d",
         .effect = "Every object is nearer to a vertex of the topological map."}),
    option::number<&TopologicalMapOptions::edge_factor>(
        "edge_factor",
        {0.1, 0.99},
        {.source = "[smap] 3.5.1, E_f",
         .effect = "Longest edge of the topological map over vertex_distance_m."}),
};

}  // namespace

const OptionTable& option_table(const TopologicalMapOptions&) {
  static constexpr OptionTable kTable{kTopologicalMapRows};
  return kTable;
}

Result<void> validate(const TopologicalMapOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
