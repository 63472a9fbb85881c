// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/deadline.hpp"

#include "hypermap/core/base/option_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace hypermap {

namespace {

constexpr std::string_view kDeadlineNames[] = {"none", "fixed", "smap"};

constexpr OptionRow kDeadlineRows[] = {
    option::choice<&DeadlineOptions::rule>(
        "rule",
        kDeadlineNames,
        {.source = "[smap] (F.1)",
         .effect = "When no detection of a frame is begun any more; for live use, not for `map`."}),
    option::number<&DeadlineOptions::frame_s>(
        "frame_s",
        option::above(0, 3600),
        {.unit = "s", .effect = "With rule fixed, from the start of the frame."}),
};

}  // namespace

const OptionTable& option_table(const DeadlineOptions&) {
  static constexpr OptionTable kTable{kDeadlineRows};
  return kTable;
}

Result<void> validate(const DeadlineOptions& options) {
  return check_options(options);
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
