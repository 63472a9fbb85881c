// SPDX-License-Identifier: BSD-3-Clause
#include "octomap_nodes_reader.hpp"

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

/// Hands out bytes and counts nodes, so that every error can name one.
class NodeCursor {
 public:
  NodeCursor(std::string_view bytes, std::uint64_t num_nodes, const LoadBudget& budget)
      : bytes_(bytes), num_nodes_(num_nodes), budget_(budget) {}

  [[nodiscard]] Unexpected error(std::string what) const {
    return fail(ErrorCode::kMalformedFile,
                std::move(what) + " at node " + std::to_string(num_counted_),
                "octree");
  }

  /// Errors: there are more nodes than the header said; kInterrupted.
  Result<void> count_node() {
    constexpr std::uint64_t kNodesBetweenChecks = std::uint64_t{1} << 16U;
    if (num_counted_ % kNodesBetweenChecks == 0) HYPERMAP_TRY(budget_.check_stop());
    if (++num_counted_ > num_nodes_)
      return fail(ErrorCode::kMalformedFile,
                  "says " + std::to_string(num_nodes_) + " nodes, the tree has more",
                  "size");
    return {};
  }

  template <class T>
  Result<T> take() {
    if (bytes_.size() - at_ < sizeof(T)) return error("unexpected end of data");
    const T value = load<T>(bytes_, at_);
    at_ += sizeof(T);
    return value;
  }

  /// The next bytes, all there.
  Result<std::string_view> take_bytes(std::size_t count) {
    if (bytes_.size() - at_ < count) return error("unexpected end of data");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  [[nodiscard]] Result<void> finish() const {
    if (num_counted_ != num_nodes_)
      return fail(ErrorCode::kMalformedFile,
                  "says " + std::to_string(num_nodes_) + " nodes, the tree has " +
                      std::to_string(num_counted_),
                  "size");
    if (at_ != bytes_.size())
      return fail(ErrorCode::kMalformedFile,
                  std::to_string(bytes_.size() - at_) + " bytes follow the last node",
                  "octree");
    return {};
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t num_nodes_;
  std::uint64_t num_counted_ = 0;
  const LoadBudget& budget_;
};

/// An inner node whose children are being read.
struct OpenNode {
  OctomapCube cube;
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
      HYPERMAP_TRY(take_node(parent.cube.child(next)));
    }
    HYPERMAP_TRY(cursor_.finish());
    return std::move(nodes_);
  }

 private:
  Result<void> take_node(const OctomapCube& cube) {
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

  void add_leaf(const OctomapCube& cube, float log_odds) {
    OctomapTree& tree = nodes_.tree;
    OctomapLeaf leaf{
        .key = cube.key(), .depth = static_cast<std::uint8_t>(cube.depth), .log_odds = log_odds};
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
    OctomapCube cube;
    unsigned codes = 0;
    unsigned next_child = 0;
  };

  Result<void> take_inner(const OctomapCube& cube) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto codes, cursor_.take<std::uint16_t>());
    if (codes == 0)
      return cursor_.error("neither free nor occupied nor with children, which says nothing");
    if (cube.depth == kOctomapDepth) return cursor_.error("tree deeper than 16");
    open_.push_back({.cube = cube, .codes = codes});
    return {};
  }

  Result<void> take_child(BinaryChild what, const OctomapCube& cube) {
    if (what == BinaryChild::kUnknown) return {};
    HYPERMAP_TRY(cursor_.count_node());
    if (what == BinaryChild::kInner) return take_inner(cube);
    nodes_.tree.leaves.push_back(
        {.key = cube.key(),
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
