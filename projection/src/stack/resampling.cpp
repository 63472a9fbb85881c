// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/stack/resampling.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "resampler.hpp"

#include <algorithm>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kResamplingNames[] = {"nearest", "bilinear", "biodds"};

constexpr OptionRow kResamplingRows[] = {
    option::choice<&ResamplingOptions::rule>(
        "rule",
        kResamplingNames,
        {.source = "[sogm] III-C.1", .effect = "How values between the centres of cells are had."}),
    option::number<&ResamplingOptions::epsilon>(
        "epsilon",
        {.min = 1e-6, .max = 0.5, .excludes_max = true},
        {.unit = "probability",
         .source = "[sogm] Eq. (3), e0",
         .effect = "No cell counts as surer than this; larger makes edges softer."}),
};

LogOdds within(LogOdds l, LogOdds bound) {
  return std::clamp(l, -1.0 * bound, bound);
}

/// As numbers of any scale: the scale's mean, weighted.
double mixed(const CellSquare& square, double x, double y, double (*scale)(LogOdds)) {
  const double low = (1.0 - x) * scale(square.l00) + x * scale(square.l10);
  const double high = (1.0 - x) * scale(square.l01) + x * scale(square.l11);
  return (1.0 - y) * low + y * high;
}

LogOdds nearest_of(const CellSquare& square, double x, double y) {
  if (y < 0.5) return x < 0.5 ? square.l00 : square.l10;
  return x < 0.5 ? square.l01 : square.l11;
}

}  // namespace

const OptionTable& option_table(const ResamplingOptions&) {
  static constexpr OptionTable kTable{kResamplingRows};
  return kTable;
}

Result<void> validate(const ResamplingOptions& options) {
  return check_options(options);
}

LogOdds interpolated(const CellSquare& square,
                     double x,
                     double y,
                     const ResamplingOptions& options) {
  const LogOdds bound = -1.0 * LogOdds::of(options.epsilon);
  const CellSquare kept{.l00 = within(square.l00, bound),
                        .l10 = within(square.l10, bound),
                        .l01 = within(square.l01, bound),
                        .l11 = within(square.l11, bound)};
  switch (options.rule) {
    case ResamplingRule::kNearest:
      return nearest_of(kept, x, y);
    case ResamplingRule::kBilinear: {
      const double p = mixed(kept, x, y, [](LogOdds l) { return l.probability().value(); });
      return LogOdds::of(Probability(std::clamp(p, 0.0, 1.0)));
    }
    case ResamplingRule::kBiodds:
      break;
  }
  return LogOdds(mixed(kept, x, y, [](LogOdds l) { return l.value(); }));
}

Result<LogOddsGrid> resampled(const LogOddsGrid& source,
                              const GridGeometry& target,
                              const Eigen::Matrix3d& target_from_source,
                              const ResamplingOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const Resampler resampler,
                            Resampler::create(source, target, target_from_source, options));
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, LogOddsGrid::create(target));
  const CellWindow& window = resampler.window();
  for (int row = window.first.row; row < window.end.row; ++row) {
    for (int col = window.first.col; col < window.end.col; ++col) {
      grid.set({col, row}, resampler.at({col, row}));
    }
  }
  return grid;
}

}  // namespace hypermap
