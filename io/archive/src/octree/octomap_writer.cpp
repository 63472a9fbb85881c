// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_writer.hpp"

#include "octomap_node.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// A cube of the tree: its depth and the Morton code of the voxel at its lower corner.
struct OctomapCube {
  std::uint64_t code = 0;
  int depth = 0;

  /// Voxels between the cubes of two neighbouring children, along the Morton order.
  [[nodiscard]] std::uint64_t child_stride() const {
    return std::uint64_t{1} << (3U * static_cast<unsigned>(kOctomapDepth - 1 - depth));
  }
  /// Child `i` of 8: bit 0 of i is the upper half in x, bit 1 in y, bit 2 in z.
  [[nodiscard]] OctomapCube child(unsigned i) const {
    return {.code = code + i * child_stride(), .depth = depth + 1};
  }
};

/// Where a leaf lies. (Its key's code takes time and is asked for at every level.)
OctomapCube cube_of(const OctomapLeaf& leaf) {
  return {.code = leaf.key.morton(), .depth = leaf.depth};
}

bool contains(const OctomapCube& cube, const OctomapCube& leaf) {
  const unsigned shift = 3U * static_cast<unsigned>(kOctomapDepth - cube.depth);
  return cube.depth < leaf.depth && cube.code >> shift == leaf.code >> shift;
}

/// The child of `cube` in which the leaf lies.
unsigned child_towards(const OctomapCube& cube, const OctomapCube& leaf) {
  const unsigned shift = 3U * static_cast<unsigned>(kOctomapDepth - 1 - cube.depth);
  return static_cast<unsigned>(leaf.code >> shift & 7U);
}

/// Sums of the children's colours, as OctoMap averages them: white ones do not count.
struct ColorSum {
  unsigned r = 0;
  unsigned g = 0;
  unsigned b = 0;
  unsigned count = 0;

  void add(Rgb8 color) {
    if (color == kNoColor) return;
    r += color.r;
    g += color.g;
    b += color.b;
    ++count;
  }
  [[nodiscard]] Rgb8 mean() const {
    if (count == 0) return kNoColor;
    return {.r = static_cast<std::uint8_t>(r / count),
            .g = static_cast<std::uint8_t>(g / count),
            .b = static_cast<std::uint8_t>(b / count)};
  }
};

/// Writes nodes depth first: an inner node when the first leaf below it comes, completed when a
/// leaf outside it comes.
class FullWriter {
 public:
  explicit FullWriter(const OctomapTree& tree) : tree_(tree) {}

  OctomapNodeBytes write() {
    reserve();
    for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
      const OctomapCube leaf = cube_of(tree_.leaves[i]);
      while (!open_.empty() && !contains(open_.back().cube, leaf)) close();
      if (open_.empty() && leaf.depth > 0) open({});
      while (!open_.empty() && open_.back().cube.depth + 1 < leaf.depth) open(child_of_last(leaf));
      if (!open_.empty()) child_of_last(leaf);
      write_leaf(i);
    }
    while (!open_.empty()) close();
    return std::move(out_);
  }

 private:
  struct Open {
    OctomapCube cube;
    std::size_t at = 0;           // of the node's first byte
    std::size_t children_at = 0;  // of its byte of children
    std::uint8_t children = 0;
    float max_of_children = -std::numeric_limits<float>::infinity();
    ColorSum colors = {};
  };

  /// Where siblings lie together, a fifth of the nodes are inner ones at most.
  void reserve() {
    const std::size_t node = node_bytes(tree_.kind);
    out_.bytes.reserve(node * (tree_.leaves.size() + tree_.leaves.size() / 4));
  }

  /// Notes the child of the last open node in which the leaf lies.
  OctomapCube child_of_last(const OctomapCube& leaf) {
    Open& last = open_.back();
    const unsigned i = child_towards(last.cube, leaf);
    last.children = static_cast<std::uint8_t>(last.children | 1U << i);
    return last.cube.child(i);
  }

  void open(const OctomapCube& cube) {
    Open node{.cube = cube, .at = out_.bytes.size()};
    append_node(0.0F, kNoColor, nullptr);
    node.children_at = out_.bytes.size() - sizeof(std::uint8_t);
    open_.push_back(node);
  }

  void close() {
    const Open node = open_.back();
    open_.pop_back();
    store(out_.bytes, node.at, node.max_of_children);
    if (tree_.kind == OctomapKind::kColor)
      store(out_.bytes, node.at + sizeof(float), node.colors.mean());
    store(out_.bytes, node.children_at, node.children);
    update_parent(node.max_of_children, node.colors.mean());
  }

  void write_leaf(std::size_t index) {
    const OctomapLeaf& leaf = tree_.leaves[index];
    const Rgb8 color = tree_.colors.empty() ? kNoColor : tree_.colors[index];
    append_node(leaf.log_odds,
                color,
                leaf.label == OctomapLeaf::kNoLabel ? nullptr : &tree_.labels[leaf.label]);
    update_parent(leaf.log_odds, color);
  }

  /// Without children. All at once: there are millions of nodes.
  void append_node(float log_odds, Rgb8 color, const VoxelLabel* label) {
    std::array<char, sizeof(float) + sizeof(StoredLabel) + 1> node{};
    std::size_t size = 0;
    const auto add = [&](const auto& value) {
      std::memcpy(node.data() + size, &value, sizeof(value));
      size += sizeof(value);
    };
    add(log_odds);
    if (tree_.kind == OctomapKind::kColor) add(color);
    if (tree_.kind == OctomapKind::kSemantic) add(stored_label(label));
    add(std::uint8_t{0});
    out_.bytes.append(node.data(), size);
    ++out_.num_nodes;
  }

  void update_parent(float log_odds, Rgb8 color) {
    if (open_.empty()) return;
    Open& parent = open_.back();
    parent.max_of_children = std::max(parent.max_of_children, log_odds);
    parent.colors.add(color);
  }

  const OctomapTree& tree_;
  std::vector<Open> open_;
  OctomapNodeBytes out_;
};

/// Two bits for each child of an inner node; see BinaryReader.
class BinaryWriter {
 public:
  explicit BinaryWriter(const OctomapTree& tree) : tree_(tree) {}

  OctomapNodeBytes write() {
    for (const OctomapLeaf& stored : tree_.leaves) {
      const OctomapCube leaf = cube_of(stored);
      while (!open_.empty() && !contains(open_.back().cube, leaf)) open_.pop_back();
      if (open_.empty()) open({});
      while (open_.back().cube.depth + 1 < leaf.depth) open(child_of_last(leaf, kInner));
      child_of_last(leaf, stored.log_odds >= 0.0F ? kOccupied : kFree);
      ++out_.num_nodes;
    }
    return std::move(out_);
  }

 private:
  static constexpr unsigned kFree = 1;
  static constexpr unsigned kOccupied = 2;
  static constexpr unsigned kInner = 3;
  struct Open {
    OctomapCube cube;
    std::size_t at = 0;
  };

  OctomapCube child_of_last(const OctomapCube& leaf, unsigned what) {
    const Open& last = open_.back();
    const unsigned i = child_towards(last.cube, leaf);
    const unsigned codes = load<std::uint16_t>(out_.bytes, last.at) | what << 2U * i;
    store(out_.bytes, last.at, static_cast<std::uint16_t>(codes));
    return last.cube.child(i);
  }

  void open(const OctomapCube& cube) {
    open_.push_back({.cube = cube, .at = out_.bytes.size()});
    append(out_.bytes, std::uint16_t{0});
    ++out_.num_nodes;
  }

  const OctomapTree& tree_;
  std::vector<Open> open_;
  OctomapNodeBytes out_;
};

}  // namespace

OctomapNodeBytes write_full_nodes(const OctomapTree& tree) {
  return FullWriter(tree).write();
}
OctomapNodeBytes write_binary_nodes(const OctomapTree& tree) {
  return BinaryWriter(tree).write();
}

}  // namespace hypermap
