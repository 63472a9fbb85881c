// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/look_options.hpp"

#include "hypermap/core/base/option_rows.hpp"

#include <string>

namespace hypermap {
namespace {

constexpr OptionRow kLookRows[] = {
    option::choice<&LookOptions::rule>(
        "rule",
        kLookRuleNames,
        {.effect = "Whether a network looks at every N-th frame or at those that add a view."}),
    option::count<&LookOptions::every>(
        "every", {1, 1'000'000}, {.effect = "Frames from one look to the next."}),
    option::number<&LookOptions::min_distance_m>(
        "min_distance_m",
        {0, 100},
        {.unit = "m", .effect = "A frame farther from each that was looked at adds a view."}),
    option::number<&LookOptions::min_angle_rad>(
        "min_angle_rad",
        {0, 3.1416},
        {.unit = "rad", .effect = "So does one turned by more against those nearer."}),
    option::count<&LookOptions::max_gap_frames>(
        "max_gap_frames",
        {1, 1'000'000},
        {.effect = "With keyframes a look comes after so many frames at the latest."}),
};

Result<void> check_look_rule(const LookOptions& options) {
  if (options.rule == LookRule::kEvery || options.every == 1) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be 1 with keyframes, is " + std::to_string(options.every),
              "every");
}

}  // namespace

const OptionTable& option_table(const LookOptions&) {
  static constexpr OptionTable kTable{kLookRows, kRule<check_look_rule>};
  return kTable;
}

Result<void> validate(const LookOptions& options) {
  return check_options(options, "detect");
}

}  // namespace hypermap
