// SPDX-License-Identifier: BSD-3-Clause
// Options of what an object remembers of classes and sides.
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/objects/class_belief.hpp"
#include "hypermap/core/objects/visibility_histogram.hpp"

#include <algorithm>
#include <string>

namespace hypermap {
namespace {

using Belief = ClassBeliefOptions;
using Histogram = VisibilityHistogramOptions;

constexpr std::string_view kSaturationNames[] = {"clamp", "shift"};
constexpr std::string_view kHistogramConfidenceNames[] = {"evidence", "counted"};
constexpr std::string_view kTemperingNames[] = {"none", "views"};

/// The presets have the printed bounds where the default of an object's belief is wider.
constexpr OptionRow kBeliefRows[] = {
    option::number<&Belief::max_log_odds>("max_log_odds",
                                          {-1000, 1000},
                                          {.unit = "log-odds",
                                           .source = "[smap] table D.2, l_max",
                                           .effect = "Class evidence saturates here.",
                                           .smap = 10.0,
                                           .hypermap = 10.0}),
    option::number<&Belief::min_log_odds>("min_log_odds",
                                          {-1000, 1000},
                                          {.unit = "log-odds",
                                           .source = "[smap] table D.2, l_min",
                                           .effect = "Lower bound.",
                                           .smap = -10.0,
                                           .hypermap = -10.0}),
    option::choice<&Belief::saturation>(
        "saturation",
        kSaturationNames,
        {.effect = "What happens at the bound: each class stops, or all are shifted.",
         .smap = Saturation::kClamp,
         .hypermap = Saturation::kClamp}),
    option::choice<&Belief::tempering>(
        "tempering",
        kTemperingNames,
        {.effect = "What the probability of a class is read from: the sum, or views.",
         .smap = ClassTempering::kNone,
         .hypermap = ClassTempering::kNone}),
};

constexpr OptionRow kHistogramRows[] = {
    option::count<&Histogram::num_bins>(
        "num_bins", {4, 360}, {.source = "[smap] 5.1", .effect = "Bins of a full turn."}),
    option::number<&Histogram::base_increment>("base_increment",
                                               option::above(0, 1000),
                                               {.unit = "log-odds",
                                                .source = "[smap] table D.2, d_base",
                                                .effect = "What a near observation adds."}),
    option::number<&Histogram::weights>(
        "weights",
        {0, 1000},
        {.source = "[smap] table D.2, w", .effect = "Shares of the bins around the observed one."}),
    option::number<&Histogram::max_log_odds>("max_log_odds",
                                             {-1000, 1000},
                                             {.unit = "log-odds",
                                              .source = "[smap] table D.2, l_max",
                                              .effect = "Upper bound of a bin."}),
    option::number<&Histogram::min_log_odds>("min_log_odds",
                                             {-1000, 1000},
                                             {.unit = "log-odds",
                                              .source = "[smap] table D.2, l_min",
                                              .effect = "Lower bound of a bin."}),
    option::number<&Histogram::visible_above>("visible_above",
                                              {0, 1},
                                              {.unit = "probability",
                                               .source = "[smap] table D.2, f_ohc",
                                               .effect = "A bin above it says visible."}),
    option::number<&Histogram::hidden_below>("hidden_below",
                                             {0, 1},
                                             {.unit = "probability",
                                              .source = "[smap] table D.2, f_ohc",
                                              .effect = "A bin below it says hidden."}),
    option::choice<&Histogram::confidence>(
        "confidence",
        kHistogramConfidenceNames,
        {.source = "[smap] Eq. (3.26)",
         .effect = "Share of the evidence that speaks for the object, or of the bins.",
         .smap = HistogramConfidence::kCounted,
         .hypermap = HistogramConfidence::kCounted}),
};

template <class Options>
Result<void> check_bounds(const Options& options) {
  if (options.min_log_odds < options.max_log_odds) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be below max_log_odds (" + number_text(options.max_log_odds.value()) +
                  "), is " + number_text(options.min_log_odds.value()),
              "min_log_odds");
}

Result<void> check_histogram(const Histogram& options) {
  HYPERMAP_TRY(check_bounds(options));
  if (std::ranges::all_of(options.weights, [](double weight) { return weight == 0.0; })) {
    return fail(ErrorCode::kInvalidArgument, "must not all be 0", "weights");
  }
  if (options.hidden_below <= options.visible_above) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at most visible_above (" + number_text(options.visible_above) + "), is " +
                  number_text(options.hidden_below),
              "hidden_below");
}

}  // namespace

const OptionTable& option_table(const ClassBeliefOptions&) {
  static constexpr OptionTable kTable{kBeliefRows, kRule<check_bounds<ClassBeliefOptions>>};
  return kTable;
}

Result<void> validate(const ClassBeliefOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const VisibilityHistogramOptions&) {
  static constexpr OptionTable kTable{kHistogramRows, kRule<check_histogram>};
  return kTable;
}

Result<void> validate(const VisibilityHistogramOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
