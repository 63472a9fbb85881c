// SPDX-License-Identifier: BSD-3-Clause
#include "combination_arguments.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "option_flags.hpp"

namespace hypermap::app {

void CombinationArguments::add_to(CLI::App& command) {
  command.add_option("--stacking", rule, "how the class scores of several detectors become one")
      ->transform(choice_of_option("stacking.rule"))
      ->default_str(default_of_option("stacking.rule"));
  command
      .add_option("--weights",
                  weights,
                  "NAME=WEIGHT of detectors, separated by commas; others have 1 (stacking.rule "
                  "weighted)")
      ->delimiter(',');
  command.add_option(
      "--combiner", combiner, "what `hypermap combine` learnt (stacking.rule trained)");
}

std::optional<std::string> CombinationArguments::rule_text() const {
  if (rule) return rule;
  if (combiner) return "trained";
  if (!weights.empty()) return "weighted";
  return std::nullopt;
}

Result<std::optional<std::string>> CombinationArguments::weights_text() const {
  if (weights.empty()) return std::optional<std::string>();
  std::string map = "{";
  for (const std::string& text : weights) {
    const std::size_t sign = text.rfind('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be NAME=WEIGHT, is \"" + printable(text) + "\"",
                  "--weights");
    }
    map += (map.size() > 1 ? ", " : "") + yaml_scalar(text.substr(0, sign)) + ": " +
           yaml_scalar(text.substr(sign + 1));
  }
  return std::optional<std::string>(map + "}");
}

}  // namespace hypermap::app
