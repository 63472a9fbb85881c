// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kEvaluationRows[] = {
    option::number<&EvaluationOptions::gate_m>(
        "gate_m",
        option::inside(0, kUnbounded),
        {.unit = "m", .effect = "Farther centroids do not match."}),
    option::number<&EvaluationOptions::small_gate_m>(
        "small_gate_m",
        option::inside(0, kUnbounded),
        {.unit = "m", .effect = "The same for small truths."}),
    option::number<&EvaluationOptions::small_size_m>(
        "small_size_m",
        option::inside(0, kUnbounded),
        {.unit = "m", .effect = "Truths with all sides below this are small."}),
    option::number<&EvaluationOptions::min_judged_area_m2>(
        "min_judged_area_m2",
        option::below(0, kUnbounded),
        {.unit = "m2", .effect = "Smaller footprints are averaged apart."}),
    option::number<&EvaluationOptions::min_seen_share>(
        "min_seen_share",
        {0, 1},
        {.effect = "Share of a footprint from which on it counts as seen."}),
    option::names<&EvaluationOptions::classes>(
        "classes", {.effect = "Only these, after aliases; all when empty."}),
};

}  // namespace

const OptionTable& option_table(const EvaluationOptions&) {
  static constexpr OptionTable kTable{kEvaluationRows};
  return kTable;
}

Result<void> validate(const EvaluationOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
