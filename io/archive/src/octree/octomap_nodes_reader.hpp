// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The nodes of OctoMap's two formats, in file order.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"

#include <cstdint>
#include <string_view>

namespace hypermap {

/// What came out of the nodes, and what had to be mended.
struct OctomapNodes {
  OctomapTree tree;  ///< Kind and resolution are set by whoever read the header.
  std::uint64_t num_stale_inner_nodes = 0;
};

/// Reads exactly `num_nodes` nodes, which must be all of `bytes`.
/// Errors: kMalformedFile, field "octree" or "size"; kInterrupted when `budget` is told to stop.
[[nodiscard]] Result<OctomapNodes> read_full_nodes(std::string_view bytes,
                                                   OctomapKind kind,
                                                   std::uint64_t num_nodes,
                                                   const LoadBudget& budget);
[[nodiscard]] Result<OctomapNodes> read_binary_nodes(std::string_view bytes,
                                                     std::uint64_t num_nodes,
                                                     const LoadBudget& budget);

}  // namespace hypermap
