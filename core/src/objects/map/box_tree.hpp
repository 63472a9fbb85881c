// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An R-tree whose copies share its nodes.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/geometry/box.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace hypermap {

/// Boxes of objects, found by place. A value: nodes never change, so a copy shares all of them, and
/// an insertion or removal makes those on the way to its place anew.
///
/// Source: A. Guttman, "R-trees", SIGMOD 1984; splits are quadratic.
/// Deviation: removal leaves nodes with few entries as they are and drops empty ones; later
/// insertions fill them.
class BoxTree {
 public:
  BoxTree() = default;

  /// The same and one more box. Cost: O(log n).
  [[nodiscard]] BoxTree with(const Box& box, ObjectId id) const;
  /// The same without it. Requires: it is there with this very box. Cost: O(log n).
  [[nodiscard]] BoxTree without(const Box& box, ObjectId id) const;

  /// Whose boxes meet `box` (closed), in ascending order. Cost: O(log n + result).
  [[nodiscard]] std::vector<ObjectId> query(const Box& box) const;
  /// The accepted one whose box is nearest to the point; the lowest id of equals.
  [[nodiscard]] std::optional<ObjectId> nearest(const Eigen::Vector3d& point,
                                                const std::function<bool(ObjectId)>& accept) const;

 private:
  struct Node;
  using NodeRef = std::shared_ptr<const Node>;
  /// What lies below a node, or an object when `below` is null.
  struct Entry {
    Box box;
    ObjectId id;
    NodeRef below;
  };
  struct Node {
    std::vector<Entry> entries;
    bool is_leaf = true;
  };

  explicit BoxTree(NodeRef root) : root_(std::move(root)) {}
  [[nodiscard]] static Entry entry_above(Node node);
  [[nodiscard]] static std::vector<Entry> inserted(const Node& node, const Entry& added);
  [[nodiscard]] static std::vector<Entry> split(Node node);
  [[nodiscard]] static std::optional<Node> removed(const Node& node, const Box& box, ObjectId id);

  NodeRef root_;  ///< Null: empty.
};

}  // namespace hypermap
