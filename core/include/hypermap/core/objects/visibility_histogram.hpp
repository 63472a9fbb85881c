// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From which sides an object was seen, and from which it should have been and was not.
///
/// Source: [smap] 3.5.2, Eq. (3.12), (3.13), (3.26).
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// How far a histogram speaks for its object.
enum class HistogramConfidence {
  /// Sum of the positive over the sum of the absolute log-odds of all bins; 1 where nothing speaks
  /// against. Ours: a bin of p = 0.5 is undefined ([smap] 3.5.2), so it counts for neither.
  kEvidence,
  /// Bins that say "visible" over bins that say anything; 0 when none does.
  /// Source: [smap] Eq. (3.26), table D.2.
  kCounted,
};

struct VisibilityHistogramOptions {
  int num_bins = 18;            ///< Bins of a full turn: 20 degrees each.
  double base_increment = 2.0;  ///< Log-odds that a near observation adds.
  /// Share of the bins around the observed one, w; l_f = 5.
  /// Deviation: the length of the filter is fixed, since an even one has no centre.
  std::array<double, 5> weights = {0.5, 1.5, 6.0, 1.5, 0.5};
  LogOdds max_log_odds{10.0};   ///< Upper bound of a bin.
  LogOdds min_log_odds{-10.0};  ///< Lower bound of a bin.
  double visible_above = 0.7;   ///< A bin above this probability says "visible".
  double hidden_below = 0.4;    ///< A bin below this probability says "not".
  HistogramConfidence confidence = HistogramConfidence::kEvidence;

  friend bool operator==(const VisibilityHistogramOptions&,
                         const VisibilityHistogramOptions&) = default;
};

/// Errors: kInvalidArgument naming the field: bins in 4..360, weights finite, >= 0 and not all 0,
/// increment finite and > 0, bounds in order, hidden_below <= visible_above, both in [0, 1].
[[nodiscard]] Result<void> validate(const VisibilityHistogramOptions& options);
[[nodiscard]] const OptionTable& option_table(const VisibilityHistogramOptions& options);

/// Log-odds of "the object can be seen from there", per bearing of the camera as seen from the
/// object's centre, in the map frame. A value.
class VisibilityHistogram {
 public:
  VisibilityHistogram() : VisibilityHistogram(VisibilityHistogramOptions{}) {}
  /// Requires: validate(options).
  explicit VisibilityHistogram(const VisibilityHistogramOptions& options);

  /// Restores a stored histogram. Errors: as validate(options); kInvalidArgument when the number
  /// of bins differs or a value is not within the bounds.
  [[nodiscard]] static Result<VisibilityHistogram> from_bins(
      const VisibilityHistogramOptions& options, std::vector<LogOdds> bins);

  /// The object was seen from `bearing_rad` at `distance_m`.
  ///
  /// Source: [smap] Eq. (3.12), (3.13): d_b = d_base / (1 + d/2), spread over five bins around the
  /// observed one by w / sum(w), circularly, each then clamped.
  /// Requires: finite bearing (any turn), distance >= 0.
  void observe(double bearing_rad, double distance_m);

  /// The object was not there from `bearing_rad`: the same amount, times `scale`, is taken away.
  void weaken(double bearing_rad, double distance_m, double scale = 1.0);

  /// Adds the evidence of another histogram of the same object. Requires: the same options.
  void merge(const VisibilityHistogram& other);

  /// By the options' rule, in [0, 1].
  [[nodiscard]] double confidence() const;

  /// The bin of a bearing; bin 0 starts at 0, counter-clockwise. Source: [smap] figure 3.19.
  [[nodiscard]] std::size_t bin_of(double bearing_rad) const;
  [[nodiscard]] std::span<const LogOdds> bins() const noexcept { return bins_; }
  [[nodiscard]] const VisibilityHistogramOptions& options() const noexcept { return options_; }
  friend bool operator==(const VisibilityHistogram&, const VisibilityHistogram&) = default;

 private:
  void add(double bearing_rad, double increment);
  [[nodiscard]] double share_of_evidence() const;
  [[nodiscard]] double share_of_bins() const;

  VisibilityHistogramOptions options_;
  std::vector<LogOdds> bins_;
};

/// What an observation at `distance_m` adds. Source: [smap] Eq. (3.12), restored:
/// d_b(d) = d_base / (1 + d/2).
[[nodiscard]] LogOdds histogram_increment(const VisibilityHistogramOptions& options,
                                          double distance_m);

/// Difference of two angles in (-pi, pi].
///
/// Source: [smap] Eq. (3.22), g = atan2(sin, cos).
/// Erratum: the text gives the interval ]-pi/2, pi/2]; test AnglesDifferByAtMostHalfATurn.
[[nodiscard]] double angle_difference_rad(double a_rad, double b_rad);

}  // namespace hypermap
