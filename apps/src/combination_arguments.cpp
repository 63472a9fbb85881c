// SPDX-License-Identifier: BSD-3-Clause
#include "combination_arguments.hpp"

#include "hypermap/core/base/option_table.hpp"
#include "hypermap/core/segmentation/stacking.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstddef>

namespace hypermap::app {
namespace {

/// NAME=WEIGHT with a weight that `stacking.weights` takes.
CLI::Validator weight_by_name() {
  const auto& rows = option_table(StackingOptions{}).rows;
  const OptionRow& row = *std::ranges::find(rows, "weights", &OptionRow::name);
  const auto check = [&row](const std::string& text) -> std::string {
    const std::size_t sign = text.rfind('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
      return "must be NAME=WEIGHT, is \"" + printable(text) + "\"";
    }
    const auto weight = finite_number(text.substr(sign + 1));
    if (weight && row.range.contains(*weight)) return {};
    return "weights must be in " + to_string(row.range) + ", is \"" + printable(text) + "\"";
  };
  return {check, "NAME=" + to_string(row.range)};
}

}  // namespace

void CombinationArguments::add_to(CLI::App& command) {
  command.add_option("--stacking", rule, "how the class scores of several detectors become one")
      ->transform(choice_of_option("stacking.rule"))
      ->default_str(default_of_option("stacking.rule"));
  command
      .add_option("--weights",
                  weights,
                  "NAME=WEIGHT of detectors, separated by commas; others have 1 (stacking.rule "
                  "weighted)")
      ->check(weight_by_name())
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

std::optional<std::string> CombinationArguments::weights_text() const {
  if (weights.empty()) return std::nullopt;
  std::string map = "{";
  for (const std::string& text : weights) {
    const std::size_t sign = text.rfind('=');
    map += (map.size() > 1 ? ", " : "") + yaml_scalar(text.substr(0, sign)) + ": " +
           yaml_scalar(text.substr(sign + 1));
  }
  return map + "}";
}

}  // namespace hypermap::app
