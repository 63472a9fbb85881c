// SPDX-License-Identifier: BSD-3-Clause
#include "look_arguments.hpp"

#include "choices.hpp"
#include "option_flags.hpp"

#include <algorithm>

namespace hypermap::app {

void LookArguments::add_to(CLI::App& command, CLI::Option& model) {
  const OptionTable& table = option_table(given);
  command
      .add_option("--detect",
                  rule,
                  "at which frames the network looks: every N-th, or keyframes, which add a view")
      ->transform(one_of(kLookRuleNames))
      ->capture_default_str()
      ->needs(&model);
  command.add_option("--detect-every", given.every, "let the network look at every N-th frame")
      ->check(value_of_field(table, "every"))
      ->capture_default_str()
      ->needs(&model);
  command
      .add_option("--detect-distance",
                  given.min_distance_m,
                  "a keyframe is farther than this from each before it, or turned against it")
      ->check(value_of_field(table, "min_distance_m"))
      ->capture_default_str()
      ->needs(&model);
  command.add_option("--detect-angle", given.min_angle_rad, "by more than this")
      ->check(value_of_field(table, "min_angle_rad"))
      ->capture_default_str()
      ->needs(&model);
  command
      .add_option("--detect-gap",
                  given.max_gap_frames,
                  "with keyframes the network looks after so many frames at the latest")
      ->check(value_of_field(table, "max_gap_frames"))
      ->capture_default_str()
      ->needs(&model);
}

LookOptions LookArguments::options() const {
  LookOptions options = given;
  const auto named = std::ranges::find(kLookRuleNames, rule);
  options.rule = static_cast<LookRule>(named - kLookRuleNames.begin());
  return options;
}

void LookArguments::keep_to_rule() const {
  const LookOptions looks = options();
  if (looks.rule == LookRule::kKeyframes && looks.every != 1) {
    throw CLI::ValidationError("--detect-every", "goes without --detect keyframes");
  }
}

}  // namespace hypermap::app
