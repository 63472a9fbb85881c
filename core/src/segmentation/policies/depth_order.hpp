// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of two detections' things stands before the other where they are one surface.
#pragma once

#include "segmentation/depth_components.hpp"

#include <optional>
#include <vector>

namespace hypermap {

/// The depth between two things of one surface, one of which stands before the other.
struct DepthOrder {
  float border_m = 0.0F;
  bool ours_is_before = false;

  [[nodiscard]] bool is_theirs(float depth_m) const noexcept {
    return (depth_m < border_m) != ours_is_before;
  }
};

/// Per component of a window; none where depth does not tell.
using DepthOrders = std::vector<std::optional<DepthOrder>>;

/// For each connected surface the order of what our box has alone and what the other box has
/// alone: depth tells when each of the two has three percent of its box, of the other box of what
/// the window shows of it, on the surface, and their mean depths are apart by 2 cm and by half of
/// what either spreads (standard deviation). The border is in the middle of the means.
///
/// Cost: one pass over the cells of both boxes.
[[nodiscard]] DepthOrders depth_orders(const DepthWindow& window,
                                       const DepthComponents& labelled,
                                       const CompetingBox& other);

}  // namespace hypermap
