// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/depth_components.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// A hole in the depth of this many pixels does not part a surface.
constexpr int kBridgePx = 2;
/// Sensors lose this many pixels at the edge between a thing and what it hides.
constexpr int kEdgePx = 10;

constexpr std::array<std::pair<int, int>, 4> kDirections{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

void extend(PixelRect& bounds, int x, int y) {
  bounds = bounds.empty() ? PixelRect{x, y, x + 1, y + 1}
                          : PixelRect{std::min(bounds.u_begin, x),
                                      std::min(bounds.v_begin, y),
                                      std::max(bounds.u_end, x + 1),
                                      std::max(bounds.v_end, y + 1)};
}

class Labeller {
 public:
  Labeller(const DepthWindow& window,
           const std::vector<std::uint8_t>& kind_of_cell,
           const ForegroundOptions& options)
      : window_(window),
        kind_of_cell_(kind_of_cell),
        options_(options),
        reach_(1 + kBridgePx / window.block_px),
        edge_reach_(1 + kEdgePx / window.block_px) {
    result_.of_cell.assign(window.size(), kNoComponent);
  }

  DepthComponents run() && {
    for (int y = 0; y < window_.height(); ++y) {
      for (int x = 0; x < window_.width(); ++x) {
        if (is_open(window_.cell(x, y))) flood_from(x, y);
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_open(std::size_t cell) const {
    return window_.depth_m[cell] > 0.0F && result_.of_cell[cell] == kNoComponent;
  }

  void flood_from(int x, int y) {
    component_ = {.kind = kind_of_cell_[window_.cell(x, y)]};
    take(x, y);
    while (!stack_.empty()) {
      const auto [cx, cy] = stack_.back();
      stack_.pop_back();
      for (const auto& [dx, dy] : kDirections) visit_towards(cx, cy, dx, dy);
    }
    result_.components.push_back(component_);
  }

  /// Looks at the nearest measured cell in a direction: a depth edge, or more of the surface.
  void visit_towards(int x, int y, int dx, int dy) {
    const std::size_t from = window_.cell(x, y);
    for (int distance = 1; distance <= edge_reach_; ++distance) {
      const int nx = x + distance * dx;
      const int ny = y + distance * dy;
      if (nx < 0 || ny < 0 || nx >= window_.width() || ny >= window_.height()) return;
      const std::size_t to = window_.cell(nx, ny);
      if (window_.depth_m[to] == 0.0F) continue;
      if (!same_surface(from, to)) {
        count_edge(x, y, window_.depth_m[from] < window_.depth_m[to]);
      } else if (distance <= reach_ && is_open(to) && kind_of_cell_[to] == component_.kind) {
        take(nx, ny);
      }
      return;
    }
  }

  void count_edge(int x, int y, bool is_before) {
    if (!window_.box.contains(x, y)) return;
    ++(is_before ? component_.num_before : component_.num_behind);
  }

  [[nodiscard]] bool same_surface(std::size_t from, std::size_t to) const {
    const float a = window_.depth_m[from];
    const float b = window_.depth_m[to];
    return std::abs(a - b) <= allowed_step_m(std::min(a, b), options_);
  }

  void take(int x, int y) {
    result_.of_cell[window_.cell(x, y)] = static_cast<std::uint32_t>(result_.components.size());
    stack_.emplace_back(x, y);
    extend(component_.bounds, x, y);
    if (!window_.tolerant_box.contains(x, y)) ++component_.num_outside;
    if (!window_.box.contains(x, y)) return;
    extend(component_.bounds_in_box, x, y);
    ++component_.num_in_box;
  }

  const DepthWindow& window_;
  const std::vector<std::uint8_t>& kind_of_cell_;
  const ForegroundOptions& options_;
  int reach_;
  int edge_reach_;
  DepthComponents result_;
  DepthComponent component_;
  std::vector<std::pair<int, int>> stack_;
};

}  // namespace

DepthComponents connected_components(const DepthWindow& window,
                                     const std::vector<std::uint8_t>& kind_of_cell,
                                     const ForegroundOptions& options) {
  return Labeller(window, kind_of_cell, options).run();
}

}  // namespace hypermap
