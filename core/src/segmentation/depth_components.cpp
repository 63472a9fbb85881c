// SPDX-License-Identifier: BSD-3-Clause
#include "depth_components.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

/// A hole in the depth of this many pixels does not part a surface.
constexpr int kBridgePx = 2;
/// Sensors lose this many pixels at the edge between an object and what it hides.
constexpr int kEdgePx = 10;

void extend(PixelRect& bounds, int x_begin, int x_end, int y) {
  bounds = bounds.empty() ? PixelRect{x_begin, y, x_end, y + 1}
                          : PixelRect{std::min(bounds.u_begin, x_begin),
                                      std::min(bounds.v_begin, y),
                                      std::max(bounds.u_end, x_end),
                                      std::max(bounds.v_end, y + 1)};
}

/// Steps in depth at the edge of a label's cells.
struct EdgeCounts {
  std::uint32_t num_before = 0;
  std::uint32_t num_behind = 0;

  void add(const EdgeCounts& other) {
    num_before += other.num_before;
    num_behind += other.num_behind;
  }
};

/// Labels that proved to be one surface: each points to a lower one, the lowest to itself.
class LabelForest {
 public:
  std::uint32_t add() {
    parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
    return parents_.back();
  }
  [[nodiscard]] std::uint32_t root(std::uint32_t label) {
    while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
    return label;
  }
  /// Returns the lower root.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    const auto [low, high] = std::minmax({root(a), root(b)});
    parents_[high] = low;
    return low;
  }
  [[nodiscard]] std::size_t size() const { return parents_.size(); }

 private:
  std::vector<std::uint32_t> parents_;
};

/// Two passes, as is usual: labels that are joined on the way, then their components. A cell meets
/// the nearest measured cell to its left and above, and is met by those to its right and below.
class Labeller {
 public:
  Labeller(const DepthWindow& window, const std::vector<std::uint8_t>& kind_of_cell)
      : window_(window),
        kind_of_cell_(kind_of_cell),
        max_gap_cells_(1 + kBridgePx / window.block_px),
        edge_reach_(1 + kEdgePx / window.block_px),
        row_above_(window.slope_x.size(), -edge_reach_ - 1) {
    result_.of_cell.assign(window.size(), kNoComponent);
  }

  DepthComponents run() && {
    for (int y = 0; y < window_.height(); ++y) label_row(y);
    const std::vector<std::uint32_t> component_of_label = number_components();
    for (int y = 0; y < window_.height(); ++y) gather_row(y, component_of_label);
    return std::move(result_);
  }

 private:
  void label_row(int y) {
    int left = -edge_reach_ - 1;
    for (int x = 0; x < window_.width(); ++x) {
      const std::size_t cell = window_.cell(x, y);
      if (window_.depth_m[cell] == 0.0F) continue;
      label_ = kNoComponent;
      edges_ = {};
      const bool in_box = window_.box.contains(x, y);
      if (x - left <= edge_reach_) meet(cell, in_box, left, y, x - left);
      int& above = row_above_[static_cast<std::size_t>(x)];
      if (y - above <= edge_reach_) meet(cell, in_box, x, above, y - above);
      if (label_ == kNoComponent) {
        label_ = forest_.add();
        edges_of_label_.emplace_back();
        kind_of_label_.push_back(kind_of_cell_[cell]);
      }
      edges_of_label_[label_].add(edges_);
      result_.of_cell[cell] = label_;
      left = x;
      above = y;
    }
  }

  /// Looks at the nearest measured cell in a direction: a depth edge, or more of the surface.
  void meet(std::size_t cell, bool in_box, int other_x, int other_y, int distance) {
    const std::size_t other = window_.cell(other_x, other_y);
    const float depth_m = window_.depth_m[cell];
    const float other_m = window_.depth_m[other];
    const bool is_before = depth_m < other_m;
    if (std::abs(depth_m - other_m) > window_.step_m[is_before ? cell : other]) {
      if (!window_.may_be_object(cell) || !window_.may_be_object(other)) return;
      if (in_box) ++(is_before ? edges_.num_before : edges_.num_behind);
      if (!window_.box.contains(other_x, other_y)) return;
      EdgeCounts& others = edges_of_label_[result_.of_cell[other]];
      ++(is_before ? others.num_behind : others.num_before);
    } else if (distance <= max_gap_cells_ && kind_of_cell_[cell] == kind_of_cell_[other]) {
      const std::uint32_t found = result_.of_cell[other];
      label_ = label_ == kNoComponent ? found : forest_.unite(label_, found);
    }
  }

  /// Components in the order of their first cells, which is that of their lowest labels.
  std::vector<std::uint32_t> number_components() {
    std::vector<std::uint32_t> component_of_label(forest_.size());
    for (std::uint32_t label = 0; label < forest_.size(); ++label) {
      const std::uint32_t root = forest_.root(label);
      if (root == label) {
        component_of_label[label] = static_cast<std::uint32_t>(result_.components.size());
        result_.components.push_back({.kind = kind_of_label_[label]});
      }
      component_of_label[label] = component_of_label[root];
      DepthComponent& component = result_.components[component_of_label[label]];
      component.num_before += edges_of_label_[label].num_before;
      component.num_behind += edges_of_label_[label].num_behind;
    }
    return component_of_label;
  }

  void gather_row(int y, const std::vector<std::uint32_t>& component_of_label) {
    for (int x = 0; x < window_.width();) {
      const std::uint32_t label = result_.of_cell[window_.cell(x, y)];
      const std::uint32_t id = label == kNoComponent ? label : component_of_label[label];
      const int begin = x;
      for (; x < window_.width() && result_.of_cell[window_.cell(x, y)] == label; ++x) {
        result_.of_cell[window_.cell(x, y)] = id;
      }
      if (id != kNoComponent) take_run(result_.components[id], begin, x, y);
    }
  }

  /// Adds the cells [begin, end) of a row.
  void take_run(DepthComponent& component, int begin, int end, int y) {
    extend(component.bounds, begin, end, y);
    const auto clipped = [&](const PixelRect& rect) {
      const bool in_rows = y >= rect.v_begin && y < rect.v_end;
      const int first = std::max(begin, rect.u_begin);
      return std::pair(first, in_rows ? std::max(first, std::min(end, rect.u_end)) : first);
    };
    const auto [tolerant_begin, tolerant_end] = clipped(window_.tolerant_box);
    component.num_outside +=
        static_cast<std::uint32_t>((end - begin) - (tolerant_end - tolerant_begin));
    const auto [box_begin, box_end] = clipped(window_.box);
    if (box_begin == box_end) return;
    component.num_in_box += static_cast<std::uint32_t>(box_end - box_begin);
    extend(component.bounds_in_box, box_begin, box_end, y);
  }

  const DepthWindow& window_;
  const std::vector<std::uint8_t>& kind_of_cell_;
  int max_gap_cells_;
  int edge_reach_;
  std::vector<int> row_above_;  // per column the last row with a measured cell
  LabelForest forest_;
  std::vector<EdgeCounts> edges_of_label_;
  std::vector<std::uint8_t> kind_of_label_;
  std::uint32_t label_ = kNoComponent;  // of the present cell
  EdgeCounts edges_;                    // of the present cell
  DepthComponents result_;
};

}  // namespace

DepthComponents connected_components(const DepthWindow& window,
                                     const std::vector<std::uint8_t>& kind_of_cell) {
  return Labeller(window, kind_of_cell).run();
}

}  // namespace hypermap
