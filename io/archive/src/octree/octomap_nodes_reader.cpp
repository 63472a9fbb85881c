// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_nodes_reader.hpp"

#include "hypermap/octree_semantic/octree/voxel_key.hpp"
#include "node_cursor.hpp"
#include "octomap_node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// A cube of the tree: its depth and the voxel at its lower corner.
struct ReadCube {
  VoxelKey key = {};
  int depth = 0;

  /// Child `i` of 8: bit 0 of i is the upper half in x, bit 1 in y, bit 2 in z. Requires: depth
  /// below that of voxels.
  [[nodiscard]] ReadCube child(unsigned i) const {
    const unsigned shift = static_cast<unsigned>(kOctomapDepth - 1 - depth);
    return {.key = {.x = static_cast<std::uint16_t>(key.x | (i & 1U) << shift),
                    .y = static_cast<std::uint16_t>(key.y | (i >> 1U & 1U) << shift),
                    .z = static_cast<std::uint16_t>(key.z | (i >> 2U & 1U) << shift)},
            .depth = depth + 1};
  }
};

/// An inner node whose children are being read.
struct OpenNode {
  ReadCube cube;
  unsigned children = 0;  // bits of those still to come
  float log_odds = 0.0F;
  float max_of_children = -std::numeric_limits<float>::infinity();
};

/// Reads `.ot` nodes in their order, depth first, with a stack of at most sixteen open nodes.
class FullReader {
 public:
  FullReader(std::string_view bytes,
             OctomapKind kind,
             std::uint64_t num_nodes,
             const LoadBudget& budget)
      : cursor_(bytes, num_nodes, budget), kind_(kind) {
    open_.reserve(kOctomapDepth);
    constexpr std::size_t kLeastNodeBytes = sizeof(float) + sizeof(std::uint8_t);
    nodes_.tree.leaves.reserve(std::min<std::uint64_t>(num_nodes, bytes.size() / kLeastNodeBytes));
  }

  Result<OctomapNodes> read() {
    HYPERMAP_TRY(take_node({}));
    while (!open_.empty()) {
      OpenNode& parent = open_.back();
      if (parent.children == 0) {
        close(parent);
        continue;
      }
      const auto next = static_cast<unsigned>(std::countr_zero(parent.children));
      parent.children &= parent.children - 1;
      const ReadCube cube = parent.cube.child(next);
      if (!take_plain_leaf(cube)) HYPERMAP_TRY(take_node(cube));
    }
    HYPERMAP_TRY(cursor_.finish());
    return std::move(nodes_);
  }

 private:
  /// Most nodes are leaves without a label or colour: those it takes quickly. False, and nothing is
  /// taken, for any other one.
  bool take_plain_leaf(const ReadCube& cube) {
    if (kind_ == OctomapKind::kColor) return false;
    const std::size_t size = node_bytes(kind_);
    const std::string_view node = cursor_.ahead(size);
    if (node.size() < size || node.back() != '\0') return false;
    const auto log_odds = load<float>(node, 0);
    if (!(std::abs(log_odds) <= kMaxLogOdds)) return false;
    if (kind_ == OctomapKind::kSemantic && !is_blank(load<StoredLabel>(node, sizeof(float))))
      return false;
    if (!cursor_.pass_node(size)) return false;
    nodes_.tree.leaves.push_back(
        {.key = cube.key, .depth = static_cast<std::uint8_t>(cube.depth), .log_odds = log_odds});
    update_parent(log_odds);
    return true;
  }

  Result<void> take_node(const ReadCube& cube) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view node, cursor_.take_bytes(node_bytes(kind_)));
    const auto log_odds = load<float>(node, 0);
    if (!(std::abs(log_odds) <= kMaxLogOdds))
      return cursor_.error("log-odds are " + std::to_string(log_odds) +
                           ", expected within +-32.767");
    if (kind_ == OctomapKind::kColor) color_ = load<Rgb8>(node, sizeof(float));
    if (kind_ == OctomapKind::kSemantic)
      HYPERMAP_TRY(set_label(load<StoredLabel>(node, sizeof(float))));
    const auto children = load<std::uint8_t>(node, node.size() - 1);
    HYPERMAP_TRY(cursor_.count_node());
    if (children == 0) {
      add_leaf(cube, log_odds);
      return {};
    }
    if (cube.depth == kOctomapDepth) return cursor_.error("tree deeper than 16");
    open_.push_back({.cube = cube, .children = children, .log_odds = log_odds});
    return {};
  }

  Result<void> set_label(const StoredLabel& stored) {
    label_ = label_of(stored);
    if (!label_) return {};
    if (const auto valid = validate(*label_, std::numeric_limits<MilliLogOdds>::max()); !valid)
      return cursor_.error("label: " + valid.error().field + " " + valid.error().what);
    return {};
  }

  void add_leaf(const ReadCube& cube, float log_odds) {
    OctomapTree& tree = nodes_.tree;
    OctomapLeaf leaf{
        .key = cube.key, .depth = static_cast<std::uint8_t>(cube.depth), .log_odds = log_odds};
    if (kind_ == OctomapKind::kColor) tree.colors.push_back(color_);
    if (label_) {
      leaf.label = static_cast<std::uint32_t>(tree.labels.size());
      tree.labels.push_back(*label_);
    }
    tree.leaves.push_back(leaf);
    update_parent(log_odds);
  }

  void update_parent(float log_odds) {
    if (open_.empty()) return;
    float& max = open_.back().max_of_children;
    max = std::max(max, log_odds);
  }

  void close(const OpenNode& node) {
    const float computed = node.max_of_children;
    if (computed != node.log_odds) ++nodes_.num_stale_inner_nodes;
    open_.pop_back();
    update_parent(computed);
  }

  NodeCursor cursor_;
  OctomapKind kind_;
  std::vector<OpenNode> open_;
  Rgb8 color_;
  std::optional<VoxelLabel> label_;
  OctomapNodes nodes_;
};

/// What two bits of a `.bt` node say of a child. Source: OctoMap, readBinaryNode.
enum class BinaryChild : unsigned { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

constexpr float kBinaryFree = -2.0F;       // OctoMap's clamping values, logit of 0.1192
constexpr float kBinaryOccupied = 3.511F;  // and of 0.971

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::uint64_t num_nodes, const LoadBudget& budget)
      : cursor_(bytes, num_nodes, budget) {
    open_.reserve(kOctomapDepth);
  }

  Result<OctomapNodes> read() {
    HYPERMAP_TRY(cursor_.count_node());
    HYPERMAP_TRY(take_inner({}));
    while (!open_.empty()) {
      Open& parent = open_.back();
      if (parent.next_child == 8) {
        open_.pop_back();
        continue;
      }
      const unsigned i = parent.next_child++;
      HYPERMAP_TRY(
          take_child(static_cast<BinaryChild>(parent.codes >> 2U * i & 3U), parent.cube.child(i)));
    }
    HYPERMAP_TRY(cursor_.finish());
    return std::move(nodes_);
  }

 private:
  struct Open {
    ReadCube cube;
    unsigned codes = 0;
    unsigned next_child = 0;
  };

  Result<void> take_inner(const ReadCube& cube) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto codes, cursor_.take<std::uint16_t>());
    if (codes == 0)
      return cursor_.error("neither free nor occupied nor with children, which says nothing");
    if (cube.depth == kOctomapDepth) return cursor_.error("tree deeper than 16");
    open_.push_back({.cube = cube, .codes = codes});
    return {};
  }

  Result<void> take_child(BinaryChild what, const ReadCube& cube) {
    if (what == BinaryChild::kUnknown) return {};
    HYPERMAP_TRY(cursor_.count_node());
    if (what == BinaryChild::kInner) return take_inner(cube);
    nodes_.tree.leaves.push_back(
        {.key = cube.key,
         .depth = static_cast<std::uint8_t>(cube.depth),
         .log_odds = what == BinaryChild::kFree ? kBinaryFree : kBinaryOccupied});
    return {};
  }

  NodeCursor cursor_;
  std::vector<Open> open_;
  OctomapNodes nodes_;
};

}  // namespace

Result<OctomapNodes> read_full_nodes(std::string_view bytes,
                                     OctomapKind kind,
                                     std::uint64_t num_nodes,
                                     const LoadBudget& budget) {
  return FullReader(bytes, kind, num_nodes, budget).read();
}

Result<OctomapNodes> read_binary_nodes(std::string_view bytes,
                                       std::uint64_t num_nodes,
                                       const LoadBudget& budget) {
  return BinaryReader(bytes, num_nodes, budget).read();
}

}  // namespace hypermap
