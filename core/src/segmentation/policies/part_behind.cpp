// SPDX-License-Identifier: BSD-3-Clause
#include "part_behind.hpp"

#include "surface_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

/// A part behind the others, across what was not measured, is a whole thing in the box that hardly
/// anything hides: it has at least so many cells, no more than this share of them outside the box,
/// and this share of its edge is its own outline.
constexpr std::uint32_t kBehindMinCells = 24;
constexpr double kBehindMaxOutside = 0.02;
constexpr double kBehindMinOutline = 0.65;
/// It is no farther behind than this share of the box's width there: objects are seldom much deeper
/// than wide, what stands farther behind is another one.
constexpr float kBehindMaxOfWidth = 0.65F;
/// Something nearer hides the foot of what stands behind an object, not that of its parts.
constexpr double kBehindMaxHiddenFoot = 0.25;
/// A box ends where its object ends: without its top so much of the box's height would be empty,
/// and the top ends no farther from the box's edge.
constexpr double kLeastUncovered = 0.15;
constexpr double kMostBesideEdge = 0.08;
/// It is so wide, of the box: no other thing that looks over the object.
constexpr double kLeastTopWidth = 0.4;
/// What is so flat in the picture has no upper end of its own.
constexpr double kLeastBoxHeight = 0.4;
/// With it the object is no deeper than this many times the box's width there.
constexpr float kMostDepthOfWidth = 1.5F;
/// Or its best surface leads there: it is so much of the whole depth, as a mattress that is seen
/// from the foot and ends short of the head, where it is seen too flat. The seat of a chair is less
/// deep than that, and leads to what stands behind the chair.
constexpr float kLeastLeadingShare = 2.0F / 3.0F;
constexpr float kLeastLeadingM = 1.0F;
/// And without its side so much of the box's width, by what is so high.
constexpr double kLeastBeside = 0.15;
constexpr double kLeastSideHeight = 0.3;
/// Nothing that is seen along its length is longer: a sofa, a bed, a table.
constexpr float kMostLengthM = 2.5F;
/// What hides a foot is measured within so many cells of it.
constexpr int kFootReachCells = 3;

float mean_depth_m(const DepthWindow& window, const DepthComponents& labelled, std::uint32_t id) {
  float sum_m = 0.0F;
  for_each_cell_of(
      window, labelled, id, [&](int x, int y) { sum_m += window.depth_m[window.cell(x, y)]; });
  return sum_m / static_cast<float>(labelled.components[id].num_in_box);
}

struct DepthRange {
  float nearest_m = std::numeric_limits<float>::infinity();
  float farthest_m = 0.0F;
};

DepthRange depth_range(const DepthWindow& window,
                       const DepthComponents& labelled,
                       std::uint32_t id) {
  DepthRange range;
  for_each_cell_of(window, labelled, id, [&](int x, int y) {
    const float depth_m = window.depth_m[window.cell(x, y)];
    range.nearest_m = std::min(range.nearest_m, depth_m);
    range.farthest_m = std::max(range.farthest_m, depth_m);
  });
  return range;
}

/// Of the box at a depth.
float box_width_m(const DepthWindow& window, float depth_m) {
  const auto end = static_cast<std::size_t>(window.box.u_end - 1);
  const auto begin = static_cast<std::size_t>(window.box.u_begin);
  return (window.slope_x[end] - window.slope_x[begin]) * depth_m;
}

/// Of the columns of a surface in the box, the share below whose last cell something nearer was
/// measured.
double hidden_foot_share(const DepthWindow& window,
                         const DepthComponents& labelled,
                         std::uint32_t id) {
  const PixelRect& bounds = labelled.components[id].bounds_in_box;
  int num_columns = 0;
  int num_hidden = 0;
  for (int x = bounds.u_begin; x < bounds.u_end; ++x) {
    int y = bounds.v_end - 1;
    while (y >= bounds.v_begin && labelled.of_cell[window.cell(x, y)] != id) --y;
    if (y < bounds.v_begin) continue;
    ++num_columns;
    const std::size_t foot = window.cell(x, y);
    const int end = std::min(y + 1 + kFootReachCells, window.height());
    for (++y; y < end; ++y) {
      const float depth_m = window.depth_m[window.cell(x, y)];
      if (depth_m == 0.0F) continue;
      if (depth_m < window.depth_m[foot] - window.step_m[foot]) ++num_hidden;
      break;
    }
  }
  return num_hidden / std::max(1.0, static_cast<double>(num_columns));
}

/// How deep the object is with surface `id`, and with the best one alone.
struct Depths {
  float whole_m = 0.0F;
  float of_best_m = 0.0F;
  bool is_behind = false;  ///< Surface `id` reaches farther back.
};

Depths depths_of(const DepthWindow& window,
                 const DepthComponents& labelled,
                 std::uint32_t best,
                 std::uint32_t id) {
  const DepthRange of_best = depth_range(window, labelled, best);
  const DepthRange of_end = depth_range(window, labelled, id);
  return {.whole_m = of_end.farthest_m - of_best.nearest_m,
          .of_best_m = of_best.farthest_m - of_best.nearest_m,
          .is_behind = of_end.farthest_m >= of_best.farthest_m};
}

}  // namespace

bool is_top_of_box(const DepthWindow& window,
                   const DepthComponents& labelled,
                   const PixelRect& covered,
                   std::uint32_t best,
                   std::uint32_t id) {
  const DepthComponent& component = labelled.components[id];
  const PixelRect& box = window.box;
  const double height = box.height();
  const bool is_cut = window.box_px.v_min_px < 1.0 || component.bounds.v_begin == 0;
  if (is_cut || component.num_in_box < kBehindMinCells) return false;
  if (height < kLeastBoxHeight * box.width()) return false;
  if (component.bounds_in_box.width() < kLeastTopWidth * box.width()) return false;
  if (covered.v_begin - box.v_begin < kLeastUncovered * height) return false;
  if (std::abs(component.bounds.v_begin - box.v_begin) > std::max(1.0, kMostBesideEdge * height))
    return false;
  const Depths depths = depths_of(window, labelled, best, id);
  if (!depths.is_behind) return false;
  const float width_m = box_width_m(window, mean_depth_m(window, labelled, best));
  return depths.whole_m <= kMostDepthOfWidth * width_m ||
         (depths.whole_m <= kMostLengthM &&
          depths.of_best_m >= std::max(kLeastLeadingM, kLeastLeadingShare * depths.whole_m));
}

bool is_side_of_box(const DepthWindow& window,
                    const DepthComponents& labelled,
                    const PixelRect& covered,
                    std::uint32_t best,
                    std::uint32_t id) {
  const DepthComponent& component = labelled.components[id];
  const PixelRect& box = window.box;
  if (component.num_in_box < kBehindMinCells) return false;
  if (component.bounds_in_box.height() < kLeastSideHeight * box.height() ||
      component.bounds_in_box.width() < kLeastTopWidth * box.width())
    return false;
  const double most_off = std::max(1.0, kMostBesideEdge * box.width());
  const auto ends_it = [&](int uncovered, int off, bool is_cut) {
    return !is_cut && uncovered >= kLeastBeside * box.width() && std::abs(off) <= most_off;
  };
  const PixelRect& bounds = component.bounds;
  const bool is_left = ends_it(covered.u_begin - box.u_begin,
                               bounds.u_begin - box.u_begin,
                               std::min(box.u_begin, bounds.u_begin) == 0);
  const bool is_right = ends_it(box.u_end - covered.u_end,
                                bounds.u_end - box.u_end,
                                std::max(box.u_end, bounds.u_end) == window.width());
  if (!is_left && !is_right) return false;
  const float there_m = kMostDepthOfWidth * box_width_m(window, mean_depth_m(window, labelled, id));
  const Depths depths = depths_of(window, labelled, best, id);
  return depths.is_behind && depths.whole_m <= std::min(there_m, kMostLengthM);
}

bool is_part_behind(const DepthWindow& window,
                    const DepthComponents& labelled,
                    std::uint32_t best,
                    std::uint32_t id) {
  const DepthComponent& component = labelled.components[id];
  if (component.num_in_box < kBehindMinCells || component.outside_share() > kBehindMaxOutside ||
      component.outline_share() < kBehindMinOutline ||
      hidden_foot_share(window, labelled, id) > kBehindMaxHiddenFoot)
    return false;
  const float depth_m = mean_depth_m(window, labelled, best);
  const float behind_m = mean_depth_m(window, labelled, id) - depth_m;
  return behind_m >= 0.0F && behind_m <= kBehindMaxOfWidth * box_width_m(window, depth_m);
}

}  // namespace hypermap
