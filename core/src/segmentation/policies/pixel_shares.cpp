// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_shares.hpp"

#include "depth_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// A surface is in both boxes when it has so much of what the window shows of the other one ...
constexpr double kTheirLeastShare = 0.2;
/// ... and so much of ours, beside what is the other's.
constexpr double kOurLeastShare = 0.1;
/// A box lies in another with this share of its area, when it has no more than that of the other's.
constexpr double kInsideShare = 0.8;
constexpr double kInnerMostArea = 0.6;

double area_px2(const PixelBox& box) {
  return box.width_px() * box.height_px();
}

double common_area_px2(const PixelBox& a, const PixelBox& b) {
  const double width = std::min(a.u_max_px, b.u_max_px) - std::max(a.u_min_px, b.u_min_px);
  const double height = std::min(a.v_max_px, b.v_max_px) - std::max(a.v_min_px, b.v_min_px);
  return std::max(width, 0.0) * std::max(height, 0.0);
}

bool lies_in(const PixelBox& inner, const PixelBox& outer) {
  return common_area_px2(inner, outer) >= kInsideShare * area_px2(inner) &&
         area_px2(inner) <= kInnerMostArea * area_px2(outer);
}

/// How far from the middle of the box along one axis, 1 at its edge.
double columns_from_middle(const PixelBox& box, double u_px) {
  return std::abs(2.0 * u_px - box.u_min_px - box.u_max_px) / box.width_px();
}
double rows_from_middle(const PixelBox& box, double v_px) {
  return std::abs(2.0 * v_px - box.v_min_px - box.v_max_px) / box.height_px();
}

/// To whom cells in both boxes belong.
enum class Precedence { kOurs, kTheirs, kNearerMiddle };

Precedence precedence(const PixelBox& ours, const PixelBox& theirs) {
  if (lies_in(theirs, ours)) return Precedence::kTheirs;
  if (lies_in(ours, theirs)) return Precedence::kOurs;
  return Precedence::kNearerMiddle;
}

/// Calls `visit(cell, component, is_in_our_box)` for the measured cells of the window that belong
/// to the other box.
template <class Visit>
void for_each_cell_of_other(const DepthWindow& window,
                            const DepthComponents& labelled,
                            const CompetingBox& other,
                            const DepthOrders& orders,
                            Visit visit) {
  const Precedence in_both = precedence(window.box_px, other.box_px);
  for (int y = other.cells.v_begin; y < other.cells.v_end; ++y) {
    const double v_px = window.pixel_v(y) + 0.5;
    const double our_rows = rows_from_middle(window.box_px, v_px);
    const double their_rows = rows_from_middle(other.box_px, v_px);
    const auto is_theirs_in_both = [&](int x, std::size_t cell, std::uint32_t id) {
      if (in_both != Precedence::kNearerMiddle) return in_both == Precedence::kTheirs;
      if (orders[id]) return orders[id]->is_theirs(window.depth_m[cell]);
      const double u_px = window.pixel_u(x) + 0.5;
      return std::max(columns_from_middle(other.box_px, u_px), their_rows) <
             std::max(columns_from_middle(window.box_px, u_px), our_rows);
    };
    for (int x = other.cells.u_begin; x < other.cells.u_end; ++x) {
      const std::size_t cell = window.cell(x, y);
      const std::uint32_t id = labelled.of_cell[cell];
      if (id == kNoComponent) continue;
      const bool is_in_our_box = window.box.contains(x, y);
      if (is_in_our_box && !is_theirs_in_both(x, cell, id)) continue;
      visit(cell, id, is_in_our_box);
    }
  }
}

struct CellCounts {
  std::uint32_t theirs = 0;
  std::uint32_t theirs_in_our_box = 0;
};

std::vector<CellCounts> count_cells_of_other(const DepthWindow& window,
                                             const DepthComponents& labelled,
                                             const CompetingBox& other) {
  std::vector<CellCounts> counts(labelled.components.size());
  const DepthOrders by_middle(labelled.components.size());
  for_each_cell_of_other(window,
                         labelled,
                         other,
                         by_middle,
                         [&](std::size_t /*cell*/, std::uint32_t id, bool is_in_our_box) {
                           ++counts[id].theirs;
                           counts[id].theirs_in_our_box += is_in_our_box ? 1U : 0U;
                         });
  return counts;
}

double num_cells(const PixelRect& cells) {
  return static_cast<double>(cells.width()) * cells.height();
}

/// Per component whether it fills both boxes.
std::vector<bool> shared_components(const DepthWindow& window,
                                    const DepthComponents& labelled,
                                    const CompetingBox& other) {
  const auto counts = count_cells_of_other(window, labelled, other);
  std::vector<bool> is_shared(counts.size(), false);
  for (std::size_t id = 0; id < counts.size(); ++id) {
    const DepthComponent& component = labelled.components[id];
    const double ours = component.num_in_box - counts[id].theirs_in_our_box;
    is_shared[id] = component.kind == 0 &&
                    counts[id].theirs >= kTheirLeastShare * num_cells(other.cells) &&
                    ours >= kOurLeastShare * num_cells(window.box);
  }
  return is_shared;
}

}  // namespace

std::vector<std::uint8_t> shared_out(const DepthWindow& window,
                                     const DepthComponents& labelled,
                                     std::vector<std::uint8_t> kind_of_cell) {
  if (window.is_masked()) return kind_of_cell;
  for (const CompetingBox& other : window.competing_boxes) {
    const std::vector<bool> is_shared = shared_components(window, labelled, other);
    if (std::find(is_shared.begin(), is_shared.end(), true) == is_shared.end()) continue;
    for_each_cell_of_other(window,
                           labelled,
                           other,
                           depth_orders(window, labelled, other),
                           [&](std::size_t cell, std::uint32_t id, bool /*is_in_our_box*/) {
                             if (is_shared[id]) kind_of_cell[cell] = kOthersKind;
                           });
  }
  return kind_of_cell;
}

}  // namespace hypermap
