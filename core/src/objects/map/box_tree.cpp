// SPDX-License-Identifier: BSD-3-Clause
#include "objects/map/box_tree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxNodeEntries = 16;
constexpr std::size_t kMinNodeEntries = 6;

/// Sum of the edges: unlike the volume it tells flat boxes apart.
double edge_sum_m(const Box& box) {
  return (box.max_in_map - box.min_in_map).sum();
}

double squared_distance_to_m2(const Eigen::Vector3d& point, const Box& box) {
  const Eigen::Vector3d outside =
      (box.min_in_map - point).cwiseMax(point - box.max_in_map).cwiseMax(0.0);
  return outside.squaredNorm();
}

}  // namespace

BoxTree::Entry BoxTree::entry_above(Node node) {
  Box box = node.entries.front().box;
  for (const Entry& entry : node.entries) box = bounding_box(box, entry.box);
  return {box, kNoObject, std::make_shared<const Node>(std::move(node))};
}

BoxTree BoxTree::with(const Box& box, ObjectId id) const {
  const Entry added{box, id, nullptr};
  if (!root_) return BoxTree(std::make_shared<const Node>(Node{{added}, true}));
  std::vector<Entry> made = inserted(*root_, added);
  if (made.size() == 1) return BoxTree(std::move(made.front().below));
  return BoxTree(std::make_shared<const Node>(Node{std::move(made), false}));
}

/// The node with one more entry below it, as one entry or as two.
std::vector<BoxTree::Entry> BoxTree::inserted(const Node& node, const Entry& added) {
  Node changed = node;
  if (node.is_leaf) {
    changed.entries.push_back(added);
  } else {
    const auto cost = [&added](const Entry& entry) {
      const double before = edge_sum_m(entry.box);
      return std::pair(edge_sum_m(bounding_box(entry.box, added.box)) - before, before);
    };
    const auto best = std::min_element(
        changed.entries.begin(), changed.entries.end(), [&](const Entry& a, const Entry& b) {
          return cost(a) < cost(b);
        });
    std::vector<Entry> below = inserted(*best->below, added);
    *best = std::move(below.front());
    if (below.size() > 1) changed.entries.push_back(std::move(below.back()));
  }
  if (changed.entries.size() > kMaxNodeEntries) return split(std::move(changed));
  return {entry_above(std::move(changed))};
}

/// Guttman's quadratic split: the two that fit together worst begin, then always the entry that
/// prefers one side most.
std::vector<BoxTree::Entry> BoxTree::split(Node node) {
  std::vector<Entry>& rest = node.entries;
  std::size_t first = 0;
  std::size_t second = 1;
  double worst = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    for (std::size_t k = i + 1; k < rest.size(); ++k) {
      const double waste = edge_sum_m(bounding_box(rest[i].box, rest[k].box)) -
                           edge_sum_m(rest[i].box) - edge_sum_m(rest[k].box);
      if (waste > worst) std::tie(worst, first, second) = std::tuple(waste, i, k);
    }
  }
  std::array<Node, 2> sides{Node{{rest[first]}, node.is_leaf}, Node{{rest[second]}, node.is_leaf}};
  std::array<Box, 2> boxes{rest[first].box, rest[second].box};
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(second));
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(first));
  while (!rest.empty()) {
    const auto preference = [&boxes](const Entry& entry) {  // > 0: for the second side
      return (edge_sum_m(bounding_box(boxes[0], entry.box)) - edge_sum_m(boxes[0])) -
             (edge_sum_m(bounding_box(boxes[1], entry.box)) - edge_sum_m(boxes[1]));
    };
    const auto next =
        std::max_element(rest.begin(), rest.end(), [&](const Entry& a, const Entry& b) {
          return std::abs(preference(a)) < std::abs(preference(b));
        });
    std::size_t side = preference(*next) > 0.0 ? 1 : 0;
    for (const std::size_t needy : {std::size_t{0}, std::size_t{1}}) {
      if (sides[needy].entries.size() + rest.size() <= kMinNodeEntries) side = needy;
    }
    boxes[side] = bounding_box(boxes[side], next->box);
    sides[side].entries.push_back(std::move(*next));
    rest.erase(next);
  }
  return {entry_above(std::move(sides[0])), entry_above(std::move(sides[1]))};
}

BoxTree BoxTree::without(const Box& box, ObjectId id) const {
  std::optional<Node> changed = root_ ? removed(*root_, box, id) : std::nullopt;
  assert(changed);
  if (changed->entries.empty()) return {};
  if (!changed->is_leaf && changed->entries.size() == 1) {
    return BoxTree(std::move(changed->entries.front().below));
  }
  return BoxTree(std::make_shared<const Node>(*std::move(changed)));
}

/// The node without the object; none when it is not below.
std::optional<BoxTree::Node> BoxTree::removed(const Node& node, const Box& box, ObjectId id) {
  for (std::size_t i = 0; i < node.entries.size(); ++i) {
    const Entry& entry = node.entries[i];
    if (node.is_leaf ? entry.id != id : !entry.box.intersects(box)) continue;
    std::optional<Node> below = node.is_leaf ? Node{} : removed(*entry.below, box, id);
    if (!below) continue;
    Node changed = node;
    if (below->entries.empty()) {
      changed.entries.erase(changed.entries.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      changed.entries[i] = entry_above(*std::move(below));
    }
    return changed;
  }
  return std::nullopt;
}

std::vector<ObjectId> BoxTree::query(const Box& box) const {
  std::vector<ObjectId> ids;
  std::vector<const Node*> open;
  if (root_) open.push_back(root_.get());
  while (!open.empty()) {
    const Node& node = *open.back();
    open.pop_back();
    for (const Entry& entry : node.entries) {
      if (!entry.box.intersects(box)) continue;
      if (node.is_leaf) {
        ids.push_back(entry.id);
      } else {
        open.push_back(entry.below.get());
      }
    }
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::optional<ObjectId> BoxTree::nearest(const Eigen::Vector3d& point,
                                         const std::function<bool(ObjectId)>& accept) const {
  // Nearest first; at the same distance nodes before objects, and objects by their ids.
  using Open = std::tuple<double, ObjectId, const Node*>;
  const auto is_later = [](const Open& a, const Open& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) > std::tie(std::get<0>(b), std::get<1>(b));
  };
  std::priority_queue<Open, std::vector<Open>, decltype(is_later)> open(is_later);
  if (root_) open.emplace(0.0, kNoObject, root_.get());
  while (!open.empty()) {
    const auto [distance, id, node] = open.top();
    open.pop();
    if (node == nullptr) {
      if (accept(id)) return id;
      continue;
    }
    for (const Entry& entry : node->entries) {
      open.emplace(squared_distance_to_m2(point, entry.box), entry.id, entry.below.get());
    }
  }
  return std::nullopt;
}

}  // namespace hypermap
