// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/deadline.hpp"

#include "out_of_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {

Result<void> validate(const DeadlineOptions& options) {
  if (options.frame_s > 0.0 && options.frame_s <= 3600.0) return {};
  return out_of_range("deadline.frame_s", "must be above 0 and at most 3600", options.frame_s);
}

double object_lifetime_s(std::size_t num_active) {
  constexpr double kDecay = 1.738;
  const std::size_t threads = std::clamp<std::size_t>(num_active, 1, 8);
  return std::exp(-static_cast<double>(threads) / kDecay);
}

double deadline_s(const DeadlineOptions& options, std::size_t num_detections) {
  switch (options.rule) {
    case DeadlineRule::kNone:
      break;
    case DeadlineRule::kFixed:
      return options.frame_s;
    case DeadlineRule::kSmap:
      return object_lifetime_s(num_detections);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace hypermap
