// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Trees as nodes of OctoMap's two formats.
#pragma once

#include "hypermap/io/archive/octomap_tree.hpp"

#include <cstdint>
#include <string>

namespace hypermap {

struct OctomapNodeBytes {
  std::string bytes;
  std::uint64_t num_nodes = 0;
};

/// Requires: a valid tree.
[[nodiscard]] OctomapNodeBytes write_full_nodes(const OctomapTree& tree);
/// Requires: a valid tree that is not one leaf at the root.
[[nodiscard]] OctomapNodeBytes write_binary_nodes(const OctomapTree& tree);

}  // namespace hypermap
