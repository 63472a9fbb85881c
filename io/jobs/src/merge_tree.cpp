// SPDX-License-Identifier: BSD-3-Clause
#include "merge_tree.hpp"

#include <bit>

namespace hypermap {
namespace {

/// Returns the number of the node that makes these maps; none for a single one.
// NOLINTNEXTLINE(misc-no-recursion) as deep as the logarithm of the number of maps
std::optional<std::size_t> add_nodes(std::vector<MergeNode>& nodes,
                                     std::size_t begin,
                                     std::size_t end) {
  if (end - begin < 2) return std::nullopt;
  const std::size_t middle = begin + std::bit_floor(end - begin - 1);
  MergeNode node{.begin = begin, .middle = middle, .end = end};
  node.left = add_nodes(nodes, begin, middle);
  node.right = add_nodes(nodes, middle, end);
  nodes.push_back(node);
  return nodes.size() - 1;
}

}  // namespace

std::vector<MergeNode> merge_tree(std::size_t num_maps) {
  std::vector<MergeNode> nodes;
  add_nodes(nodes, 0, num_maps);
  return nodes;
}

}  // namespace hypermap
