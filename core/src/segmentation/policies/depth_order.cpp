// SPDX-License-Identifier: BSD-3-Clause
#include "depth_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hypermap {
namespace {

/// Depth tells when each box has so much of its cells alone on the surface ...
constexpr double kLeastShareAlone = 0.03;
/// ... and the two parts are apart by more than this, and than so many of either's spreads.
constexpr double kLeastDepthStepM = 0.02;
constexpr double kLeastDepthStepInSpreads = 0.5;

/// Depths of the cells that one of two boxes has alone.
class DepthsAlone {
 public:
  void add(double depth_m) {
    if (num_ == 0) first_m_ = depth_m;
    const double from_first_m = depth_m - first_m_;
    ++num_;
    sum_m_ += from_first_m;
    sum_of_squares_m2_ += from_first_m * from_first_m;
  }
  [[nodiscard]] std::uint32_t num() const { return num_; }
  [[nodiscard]] double mean_m() const { return first_m_ + sum_m_ / num_; }
  [[nodiscard]] double spread_m() const {
    const double mean_m = sum_m_ / num_;
    return std::sqrt(std::max(sum_of_squares_m2_ / num_ - mean_m * mean_m, 0.0));
  }

 private:
  std::uint32_t num_ = 0;
  double first_m_ = 0.0;  ///< Sums are of differences to it, so that squares keep their digits.
  double sum_m_ = 0.0;
  double sum_of_squares_m2_ = 0.0;
};

/// Per component the depths of the cells of `box` that are not in `without`.
std::vector<DepthsAlone> depths_alone(const DepthWindow& window,
                                      const DepthComponents& labelled,
                                      const PixelRect& box,
                                      const PixelRect& without) {
  std::vector<DepthsAlone> depths(labelled.components.size());
  for (int y = box.v_begin; y < box.v_end; ++y) {
    for (int x = box.u_begin; x < box.u_end; ++x) {
      const std::size_t cell = window.cell(x, y);
      const std::uint32_t id = labelled.of_cell[cell];
      if (id != kNoComponent && !without.contains(x, y))
        depths[id].add(static_cast<double>(window.depth_m[cell]));
    }
  }
  return depths;
}

std::uint32_t least_alone(const PixelRect& box) {
  const double share = kLeastShareAlone * box.width() * box.height();
  return std::max(1U, static_cast<std::uint32_t>(std::ceil(share)));
}

std::optional<DepthOrder> order_of(const DepthsAlone& ours, const DepthsAlone& theirs) {
  const double step_m = theirs.mean_m() - ours.mean_m();
  const double spread_m = std::max(ours.spread_m(), theirs.spread_m());
  const double least_step_m = std::max(kLeastDepthStepM, kLeastDepthStepInSpreads * spread_m);
  if (std::abs(step_m) <= least_step_m) return std::nullopt;
  return DepthOrder{.border_m = static_cast<float>((ours.mean_m() + theirs.mean_m()) / 2),
                    .ours_is_before = step_m > 0.0};
}

}  // namespace

DepthOrders depth_orders(const DepthWindow& window,
                         const DepthComponents& labelled,
                         const CompetingBox& other) {
  const auto ours = depths_alone(window, labelled, window.box, other.cells);
  const auto theirs = depths_alone(window, labelled, other.cells, window.box);
  const std::uint32_t our_least = least_alone(window.box);
  const std::uint32_t their_least = least_alone(other.cells);
  DepthOrders orders(labelled.components.size());
  for (std::size_t id = 0; id < orders.size(); ++id) {
    if (ours[id].num() >= our_least && theirs[id].num() >= their_least)
      orders[id] = order_of(ours[id], theirs[id]);
  }
  return orders;
}

}  // namespace hypermap
