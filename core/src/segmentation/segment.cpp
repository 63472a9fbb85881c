// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/segment.hpp"

#include <algorithm>
#include <cassert>

namespace hypermap {

Probability box_confidence(double depth_extent_m,
                           double depth_slack_m,
                           double min_range_m,
                           double max_range_m) {
  assert(min_range_m < max_range_m && depth_extent_m >= 0.0);
  if (depth_extent_m <= depth_slack_m) return Probability(1.0);
  const double range_m = max_range_m - min_range_m;
  return Probability(std::clamp((range_m - (depth_extent_m - depth_slack_m)) / range_m, 0.0, 1.0));
}

}  // namespace hypermap
