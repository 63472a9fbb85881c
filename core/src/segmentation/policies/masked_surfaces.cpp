// SPDX-License-Identifier: BSD-3-Clause
#include "masked_surfaces.hpp"

#include "segmentation/mask_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

/// The edge of a mask is off by no more than this share of the side of a square of its size.
constexpr double kEdgeShare = 0.1;
/// A strip along the edge has no more than this share of its cells farther in.
constexpr double kMostInside = 0.2;
/// A surface goes on outside when so much of its edge to the outside is no step.
constexpr double kLeastGoingOn = 0.5;
/// What is seen through the object has no more of an outline than this, and is less of the mask.
constexpr double kThroughMaxOutline = 0.3;
constexpr double kThroughMaxShare = 0.5;

/// Of a surface in the mask.
struct MaskCounts {
  std::uint32_t num_inside = 0;    ///< Cells farther from the mask's edge than it may be off.
  std::uint32_t num_borders = 0;   ///< Neighbours outside the mask.
  std::uint32_t num_going_on = 0;  ///< Those of them that the surface goes on through.

  [[nodiscard]] bool goes_on() const { return num_going_on >= kLeastGoingOn * num_borders; }
};

/// How many cells the edge of the mask may be off.
int edge_reach(const DepthWindow& window) {
  const auto num_cells = std::count(window.in_mask.begin(), window.in_mask.end(), 1);
  const double by_size = kEdgeShare * std::sqrt(static_cast<double>(num_cells));
  const double most = std::ceil(kMaskTolerancePx / window.block_px);
  return static_cast<int>(std::clamp(std::round(by_size), 1.0, most));
}

std::vector<std::uint8_t> cells_inside(const DepthWindow& window) {
  std::vector<std::uint8_t> outside = window.in_mask;
  for (std::uint8_t& cell : outside) cell = cell == 0 ? 1 : 0;
  std::vector<std::uint8_t> inside = widened(window, outside, edge_reach(window));
  for (std::uint8_t& cell : inside) cell = cell == 0 ? 1 : 0;
  return inside;
}

class MaskSurvey {
 public:
  MaskSurvey(const DepthWindow& window,
             const DepthComponents& labelled,
             const std::vector<std::uint8_t>& kind_of_cell)
      : window_(window),
        labelled_(labelled),
        kind_of_cell_(kind_of_cell),
        inside_(cells_inside(window)),
        counts_(labelled.components.size()) {}

  std::vector<MaskCounts> run() && {
    for (int y = window_.box.v_begin; y < window_.box.v_end; ++y) {
      for (int x = window_.box.u_begin; x < window_.box.u_end; ++x) look_at(x, y);
    }
    return std::move(counts_);
  }

 private:
  void look_at(int x, int y) {
    const std::size_t cell = window_.cell(x, y);
    if (window_.in_mask[cell] == 0 || labelled_.of_cell[cell] == kNoComponent) return;
    MaskCounts& counts = counts_[labelled_.of_cell[cell]];
    counts.num_inside += inside_[cell];
    constexpr std::array<std::pair<int, int>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [dx, dy] : kSteps) {
      const int other_x = x + dx;
      const int other_y = y + dy;
      if (other_x < 0 || other_y < 0 || other_x >= window_.width() || other_y >= window_.height())
        continue;
      const std::size_t other = window_.cell(other_x, other_y);
      if (window_.in_mask[other] != 0) continue;
      ++counts.num_borders;
      counts.num_going_on += is_one_surface(cell, other) ? 1U : 0U;
    }
  }

  [[nodiscard]] bool is_one_surface(std::size_t cell, std::size_t other) const {
    const float depth_m = window_.depth_m[cell];
    const float other_m = window_.depth_m[other];
    if (other_m == 0.0F || kind_of_cell_[cell] != kind_of_cell_[other]) return false;
    return std::abs(depth_m - other_m) <= window_.step_m[depth_m < other_m ? cell : other];
  }

  const DepthWindow& window_;
  const DepthComponents& labelled_;
  const std::vector<std::uint8_t>& kind_of_cell_;
  std::vector<std::uint8_t> inside_;
  std::vector<MaskCounts> counts_;
};

bool is_strip_of_the_outside(const DepthComponent& component, const MaskCounts& counts) {
  return counts.num_borders > 0 && counts.goes_on() &&
         counts.num_inside <= kMostInside * component.num_in_box;
}

bool is_seen_through(const DepthComponent& component, const MaskCounts& counts, double num_all) {
  const bool is_of_the_background =
      component.kind != 0 || (counts.num_borders > 0 && counts.goes_on());
  return is_of_the_background && component.outline_share() < kThroughMaxOutline &&
         component.num_in_box < kThroughMaxShare * num_all;
}

}  // namespace

std::vector<std::uint8_t> kinds_in_mask(const DepthWindow& window,
                                        std::vector<std::uint8_t> kind_of_cell) {
  for (std::size_t cell = 0; cell < window.size(); ++cell) {
    if (window.in_mask[cell] == 0) kind_of_cell[cell] = kOthersKind;
  }
  return kind_of_cell;
}

ComponentIds masked_surfaces(const DepthWindow& window,
                             const DepthComponents& labelled,
                             const std::vector<std::uint8_t>& kind_of_cell) {
  const std::vector<MaskCounts> counts = MaskSurvey(window, labelled, kind_of_cell).run();
  ComponentIds in_mask;
  double num_all = 0.0;
  for (std::uint32_t id = 0; id < labelled.components.size(); ++id) {
    if (labelled.components[id].kind == kOthersKind) continue;
    in_mask.push_back(id);
    num_all += labelled.components[id].num_in_box;
  }
  ComponentIds chosen = in_mask;
  std::erase_if(chosen, [&](std::uint32_t id) {
    const DepthComponent& component = labelled.components[id];
    return is_strip_of_the_outside(component, counts[id]) ||
           is_seen_through(component, counts[id], num_all);
  });
  // A mask that is all edge: a sheet of paper far away.
  return chosen.empty() ? in_mask : chosen;
}

}  // namespace hypermap
