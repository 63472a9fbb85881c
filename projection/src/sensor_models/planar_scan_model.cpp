// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/planar_scan_model.hpp"

#include "beam_evidence.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "scanner_pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::size_t kMaxBeams = std::size_t{1} << 20U;
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr std::string_view kNoReturnNames[] = {"ignored", "free"};

constexpr OptionRow kPlanarScanRows[] = {
    option::section<&PlanarScanOptions::evidence>("evidence"),
    option::number<&PlanarScanOptions::min_range_m>(
        "min_range_m", {.max = 100.0}, {.unit = "m", .effect = "Nearer readings are none."}),
    option::number<&PlanarScanOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 1000.0),
        {.unit = "m", .effect = "Readings of this or more met nothing."}),
    option::choice<&PlanarScanOptions::no_return>(
        "no_return", kNoReturnNames, {.effect = "What a beam says that met nothing."}),
    option::number<&PlanarScanOptions::range_error_m>(
        "range_error_m",
        option::above(0.0, 10.0),
        {.unit = "m", .effect = "The end lies within so much of the reading, either way."}),
    option::number<&PlanarScanOptions::range_error_per_m>(
        "range_error_per_m", {}, {.unit = "m/m", .effect = "The same, for each metre of range."}),
    option::number<&PlanarScanOptions::beam_width_rad>(
        "beam_width_rad",
        {.max = 0.5},
        {.unit = "rad", .effect = "Of each beam; 0: half way to its neighbours."}),
    option::number<&PlanarScanOptions::max_beam_width_rad>(
        "max_beam_width_rad",
        option::above(0.0, 0.5),
        {.unit = "rad", .effect = "Wider gaps between beams stay unknown."}),
    option::number<&PlanarScanOptions::max_tilt_rad>(
        "max_tilt_rad",
        {.max = 0.5},
        {.unit = "rad", .effect = "A plane that is tilted more is refused."}),
};

Result<void> check_ranges(const PlanarScanOptions& options) {
  return check_above("min_range_m", options.min_range_m, "max_range_m", options.max_range_m);
}

/// From one beam to the next one, both sides of each.
struct Width {
  double right_rad = 0.0;
  double left_rad = 0.0;
};

/// How far a beam reaches towards a neighbour that is `gap_rad` away; none where the gap is wider
/// than beams are.
std::optional<double> reach(double gap_rad, double max_width_rad) {
  if (gap_rad > max_width_rad) return std::nullopt;
  return gap_rad / 2.0;
}

/// Of each beam in ascending order of bearings, which are less than a turn apart.
std::vector<Width> widths_of(const std::vector<double>& bearings,
                             const PlanarScanOptions& options) {
  const std::size_t n = bearings.size();
  if (options.beam_width_rad > 0.0) {
    return std::vector<Width>(n, {options.beam_width_rad / 2.0, options.beam_width_rad / 2.0});
  }
  std::vector<Width> widths(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? bearings[i - 1] : bearings.back() - kFullTurn;
    const double after = i + 1 < n ? bearings[i + 1] : bearings.front() + kFullTurn;
    const auto right = reach(bearings[i] - before, options.max_beam_width_rad);
    const auto left = reach(after - bearings[i], options.max_beam_width_rad);
    const double usual = options.max_beam_width_rad / 2.0;
    widths[i] = {right.value_or(left.value_or(usual)), left.value_or(right.value_or(usual))};
  }
  return widths;
}

/// The order of the beams by their bearings within (-pi, pi].
struct SortedBeams {
  std::vector<double> bearings_rad;
  std::vector<std::size_t> source;
};

SortedBeams sorted_beams(const RangeScan& scan) {
  std::vector<double> wrapped;
  wrapped.reserve(scan.bearings_rad.size());
  for (const double bearing : scan.bearings_rad) {
    wrapped.push_back(std::remainder(bearing, kFullTurn));
  }
  SortedBeams sorted;
  sorted.source.resize(wrapped.size());
  std::iota(sorted.source.begin(), sorted.source.end(), std::size_t{0});
  std::stable_sort(sorted.source.begin(), sorted.source.end(), [&](std::size_t a, std::size_t b) {
    return wrapped[a] < wrapped[b];
  });
  sorted.bearings_rad.reserve(wrapped.size());
  for (const std::size_t i : sorted.source) sorted.bearings_rad.push_back(wrapped[i]);
  return sorted;
}

/// The beams that say something.
std::vector<Beam> beams_of(const RangeScan& scan,
                           const PlanePose& pose,
                           const PlanarScanOptions& options) {
  const SortedBeams sorted = sorted_beams(scan);
  const std::vector<Width> widths = widths_of(sorted.bearings_rad, options);
  std::vector<Beam> beams;
  beams.reserve(widths.size());
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const double range_m = scan.ranges_m[sorted.source[i]];
    if (!(range_m > 0.0 && range_m >= options.min_range_m)) continue;  // NaN too
    const bool has_end = range_m < options.max_range_m;
    if (!has_end && options.no_return == NoReturnRule::kIgnored) continue;
    const double bearing = pose.yaw_rad + sorted.bearings_rad[i];
    beams.push_back({.apex = pose.place,
                     .from_rad = bearing - widths[i].right_rad,
                     .to_rad = bearing + widths[i].left_rad,
                     .range_m = std::min(range_m, options.max_range_m),
                     .error_m = options.range_error_m + options.range_error_per_m * range_m,
                     .has_end = has_end});
  }
  return beams;
}

}  // namespace

Result<void> validate(const RangeScan& scan) {
  HYPERMAP_TRY(check_scanner_pose(scan.map_from_scanner));
  if (scan.bearings_rad.size() != scan.ranges_m.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be as many as bearings, " + std::to_string(scan.bearings_rad.size()) +
                    ", are " + std::to_string(scan.ranges_m.size()),
                "ranges_m");
  }
  if (scan.ranges_m.size() > kMaxBeams) {
    return fail(ErrorCode::kLimit,
                "at most 2^20 beams, are " + std::to_string(scan.ranges_m.size()),
                "ranges_m");
  }
  const auto wrong = std::ranges::find_if_not(scan.bearings_rad, [](double bearing) {
    return std::abs(bearing) <= 2.0 * kFullTurn;  // false for NaN
  });
  if (wrong == scan.bearings_rad.end()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be within two turns of 0, is " + number_text(*wrong) + " in beam " +
                  std::to_string(wrong - scan.bearings_rad.begin()),
              "bearings_rad");
}

const OptionTable& option_table(const PlanarScanOptions&) {
  static constexpr OptionTable kTable{kPlanarScanRows, kRule<check_ranges>};
  return kTable;
}

Result<void> validate(const PlanarScanOptions& options) {
  return check_options(options);
}

Result<PlanarScanModel> PlanarScanModel::create(PlanarScanOptions options) {
  HYPERMAP_TRY(validate(options));
  return PlanarScanModel(std::move(options));
}

Result<std::vector<SensorGrid>> PlanarScanModel::grids(const RangeScan& scan) const {
  HYPERMAP_TRY(validate(scan));
  HYPERMAP_ASSIGN_OR_RETURN(const PlanePose pose,
                            level_pose(scan.map_from_scanner, options_.max_tilt_rad));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the scan", [&]() -> Result<Grids> {
    const std::vector<Beam> beams = beams_of(scan, pose, options_);
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid,
                              evidence_of_beams(beams, pose.place, options_.evidence));
    return Grids{{.layer = options_.layer, .frame_id = options_.frame_id, .grid = std::move(grid)}};
  });
}

}  // namespace hypermap
