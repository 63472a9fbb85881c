// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The bricks of a map, for those parts of this library that work on whole bricks.
#pragma once

#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "octree/brick_table.hpp"

namespace hypermap {

/// The only way to the bricks of a SemanticOctree: integration, occlusion and tests of both.
struct BrickAccess {
  [[nodiscard]] static const BrickTable& bricks(const SemanticOctree& tree) noexcept {
    return *tree.bricks_;
  }
  /// To write to, which a copy of the tree does not see. Throws std::bad_alloc when a copy shares
  /// the table, and nothing has changed then.
  [[nodiscard]] static BrickTable& writable(SemanticOctree& tree) {
    return tree.bricks_.writable();
  }
  /// Requires: `writable` was called and the tree was not copied since.
  [[nodiscard]] static BrickTable& sole(SemanticOctree& tree) noexcept {
    return tree.bricks_.sole();
  }
};

}  // namespace hypermap
