// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/visibility_histogram.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

VisibilityHistogram::VisibilityHistogram(const VisibilityHistogramOptions& options)
    : options_(options), bins_(static_cast<std::size_t>(options.num_bins)) {}

Result<VisibilityHistogram> VisibilityHistogram::from_bins(
    const VisibilityHistogramOptions& options, std::vector<LogOdds> bins) {
  HYPERMAP_TRY(validate(options));
  if (bins.size() != static_cast<std::size_t>(options.num_bins)) {
    return fail(ErrorCode::kInvalidArgument,
                "must have " + std::to_string(options.num_bins) + " bins, has " +
                    std::to_string(bins.size()),
                "histogram");
  }
  for (const LogOdds l : bins) {
    if (l >= options.min_log_odds && l <= options.max_log_odds) continue;
    return fail(ErrorCode::kInvalidArgument,
                "bins must be within the bounds, one is " + number_text(l.value()),
                "histogram");
  }
  VisibilityHistogram histogram(options);
  histogram.bins_ = std::move(bins);
  return histogram;
}

void VisibilityHistogram::observe(double bearing_rad, double distance_m) {
  add(bearing_rad, histogram_increment(options_, distance_m).value());
}

void VisibilityHistogram::weaken(double bearing_rad, double distance_m, double scale) {
  add(bearing_rad, -scale * histogram_increment(options_, distance_m).value());
}

void VisibilityHistogram::merge(const VisibilityHistogram& other) {
  assert(bins_.size() == other.bins_.size());
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    bins_[i] = std::clamp(bins_[i] + other.bins_[i], options_.min_log_odds, options_.max_log_odds);
  }
}

void VisibilityHistogram::add(double bearing_rad, double increment) {
  const double sum = std::accumulate(options_.weights.begin(), options_.weights.end(), 0.0);
  const std::size_t half = options_.weights.size() / 2;
  const std::size_t first = bin_of(bearing_rad) + bins_.size() - half;
  for (std::size_t j = 0; j < options_.weights.size(); ++j) {
    LogOdds& bin = bins_[(first + j) % bins_.size()];
    bin = std::clamp(bin + LogOdds(options_.weights[j] / sum * increment),
                     options_.min_log_odds,
                     options_.max_log_odds);
  }
}

double VisibilityHistogram::confidence() const {
  return options_.confidence == HistogramConfidence::kEvidence ? share_of_evidence()
                                                               : share_of_bins();
}

double VisibilityHistogram::share_of_evidence() const {
  double positive = 0.0;
  double all = 0.0;
  for (const LogOdds l : bins_) {
    positive += std::max(l.value(), 0.0);
    all += std::abs(l.value());
  }
  return positive == all ? 1.0 : positive / all;
}

double VisibilityHistogram::share_of_bins() const {
  std::size_t visible = 0;
  std::size_t hidden = 0;
  for (const LogOdds l : bins_) {
    const double p = l.probability().value();
    if (p > options_.visible_above) ++visible;
    if (p < options_.hidden_below) ++hidden;
  }
  return visible + hidden == 0
             ? 0.0
             : static_cast<double>(visible) / static_cast<double>(visible + hidden);
}

std::size_t VisibilityHistogram::bin_of(double bearing_rad) const {
  const double turns = bearing_rad / kTurn;
  const double share = turns - std::floor(turns);
  const auto bin = static_cast<std::size_t>(share * static_cast<double>(bins_.size()));
  return std::min(bin, bins_.size() - 1);
}

LogOdds histogram_increment(const VisibilityHistogramOptions& options, double distance_m) {
  return LogOdds(options.base_increment / (1.0 + distance_m / 2.0));
}

double angle_difference_rad(double a_rad, double b_rad) {
  const double difference_rad = a_rad - b_rad;
  const bool is_within = difference_rad > -std::numbers::pi && difference_rad <= std::numbers::pi;
  if (is_within) return difference_rad;
  const double wrapped_rad = std::atan2(std::sin(difference_rad), std::cos(difference_rad));
  return wrapped_rad > -std::numbers::pi ? wrapped_rad : std::numbers::pi;
}

}  // namespace hypermap
