// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In which pairs many maps are merged, whoever does it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hypermap {

/// What is merged of maps begin .. end - 1: those before `middle` with the others.
struct MergeNode {
  std::size_t begin = 0;
  std::size_t middle = 0;
  std::size_t end = 0;
  /// The nodes that make the two halves; none: that half is a single map.
  std::optional<std::size_t> left = std::nullopt;
  std::optional<std::size_t> right = std::nullopt;
};

/// The nodes that merge maps 0 .. num_maps - 1 in pairs of neighbours, each behind those that it
/// needs, the whole last: a left half has as many maps as the largest power of two that leaves
/// some for the right.
/// Boundary: none for a single map. Requires: num_maps > 0.
[[nodiscard]] std::vector<MergeNode> merge_tree(std::size_t num_maps);

}  // namespace hypermap
