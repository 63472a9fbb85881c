// SPDX-License-Identifier: BSD-3-Clause
#include "merge_tree.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <optional>
#include <set>

namespace hypermap {
namespace {

TEST(MergeTree, OfFiveMapsHasFourNodes) {
  const auto nodes = merge_tree(5);
  ASSERT_EQ(nodes.size(), 4U);
  const auto is = [&](std::size_t index, std::size_t begin, std::size_t middle, std::size_t end) {
    return nodes[index].begin == begin && nodes[index].middle == middle && nodes[index].end == end;
  };
  EXPECT_TRUE(is(0, 0, 1, 2));
  EXPECT_TRUE(is(1, 2, 3, 4));
  EXPECT_TRUE(is(2, 0, 2, 4));
  EXPECT_TRUE(is(3, 0, 4, 5));
  EXPECT_EQ(nodes[2].left, 0U);
  EXPECT_EQ(nodes[2].right, 1U);
  EXPECT_EQ(nodes[3].left, 2U);
  EXPECT_FALSE(nodes[3].right) << "the fifth map alone";
}

TEST(MergeTree, OfASingleMapIsEmpty) {
  EXPECT_TRUE(merge_tree(1).empty());
}

/// What a half is made of, by its node or as a single map.
bool is_half(const std::vector<MergeNode>& nodes,
             const std::optional<std::size_t>& node,
             std::size_t begin,
             std::size_t end) {
  if (!node) return end - begin == 1;
  return nodes[*node].begin == begin && nodes[*node].end == end;
}

TEST(MergeTree, MergesEachMapOnceAndNeedsOnlyWhatComesBefore) {
  for (std::size_t num_maps = 2; num_maps <= 70; ++num_maps) {
    const auto nodes = merge_tree(num_maps);
    ASSERT_EQ(nodes.size(), num_maps - 1);
    EXPECT_EQ(nodes.back().begin, 0U);
    EXPECT_EQ(nodes.back().end, num_maps);
    std::set<std::size_t> used;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const MergeNode& node = nodes[i];
      ASSERT_TRUE(is_half(nodes, node.left, node.begin, node.middle));
      ASSERT_TRUE(is_half(nodes, node.right, node.middle, node.end));
      EXPECT_TRUE(std::has_single_bit(node.middle - node.begin));
      for (const auto& half : {node.left, node.right}) {
        if (!half) continue;
        EXPECT_LT(*half, i);
        EXPECT_TRUE(used.insert(*half).second) << "a node is merged once";
      }
    }
    EXPECT_EQ(used.size(), nodes.size() - 1);
  }
}

}  // namespace
}  // namespace hypermap
