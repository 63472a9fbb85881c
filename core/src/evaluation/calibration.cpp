// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/calibration.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/base/random_numbers.hpp"
#include "running_mean.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

constexpr std::uint64_t kBootstrapStream = 0x626f6f74;  // which numbers: "boot"
constexpr double kLeastProbability = 1e-6;

constexpr OptionRow kCalibrationRows[] = {
    option::count<&CalibrationOptions::num_bins>(
        "num_bins", {1, 1000}, {.effect = "Equally filled bins of probability."}),
    option::count<&CalibrationOptions::num_resamples>(
        "num_resamples", {1, 100'000}, {.effect = "Draws of the bootstrap."}),
    option::count<&CalibrationOptions::seed>(
        "seed", option::at_least(0), {.effect = "Of the bootstrap."}),
};

/// A prediction whose outcome is the mean of those of its probability.
struct SharedOutcome {
  double probability = 0.0;
  double true_share = 0.0;
};

std::vector<SharedOutcome> with_shared_outcomes(std::vector<Prediction> predictions) {
  std::sort(predictions.begin(), predictions.end(), [](const auto& a, const auto& b) {
    return a.probability < b.probability;
  });
  std::vector<SharedOutcome> shared;
  shared.reserve(predictions.size());
  for (std::size_t first = 0; first < predictions.size();) {
    const double probability = predictions[first].probability;
    RunningMean outcomes;
    std::size_t end = first;
    for (; end < predictions.size() && predictions[end].probability == probability; ++end)
      outcomes.add(predictions[end].is_true ? 1.0 : 0.0);
    shared.resize(end, {probability, *outcomes.value()});
    first = end;
  }
  return shared;
}

/// Bin b holds the positions from n b / bins on, so that sizes differ by one at most.
std::vector<CalibrationBin> filled_bins(const std::vector<Prediction>& predictions, int num_bins) {
  const std::vector<SharedOutcome> shared = with_shared_outcomes(predictions);
  const std::size_t n = shared.size();
  const std::size_t count = std::min(n, static_cast<std::size_t>(num_bins));
  std::vector<CalibrationBin> bins;
  bins.reserve(count);
  for (std::size_t b = 0; b < count; ++b) {
    RunningMean probabilities;
    RunningMean outcomes;
    for (std::size_t i = n * b / count; i < n * (b + 1) / count; ++i) {
      probabilities.add(shared[i].probability);
      outcomes.add(shared[i].true_share);
    }
    bins.push_back({probabilities.n(), *probabilities.value(), *outcomes.value()});
  }
  return bins;
}

double error_of(const std::vector<CalibrationBin>& bins, std::size_t n) {
  double sum = 0.0;
  for (const CalibrationBin& bin : bins)
    sum += static_cast<double>(bin.n) * std::abs(bin.mean_probability - bin.true_share);
  return sum / static_cast<double>(n);
}

double log_loss_of(std::span<const Prediction> predictions) {
  RunningMean losses;
  for (const Prediction& prediction : predictions) {
    const double of_what_was =
        prediction.is_true ? prediction.probability : 1.0 - prediction.probability;
    losses.add(-std::log(std::max(of_what_was, kLeastProbability)));
  }
  return *losses.value();
}

std::vector<double> bootstrap_errors(std::span<const Prediction> predictions,
                                     const CalibrationOptions& options) {
  std::vector<double> errors;
  errors.reserve(static_cast<std::size_t>(options.num_resamples));
  for (int i = 0; i < options.num_resamples; ++i) {
    CounterRng random(options.seed, kBootstrapStream, static_cast<std::uint64_t>(i));
    std::vector<Prediction> drawn;
    drawn.reserve(predictions.size());
    for (std::size_t k = 0; k < predictions.size(); ++k)
      drawn.push_back(predictions[random.below(static_cast<std::uint32_t>(predictions.size()))]);
    errors.push_back(error_of(filled_bins(drawn, options.num_bins), drawn.size()));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// The value below which a share of the sorted values lies.
double quantile(const std::vector<double>& sorted, double share) {
  const double last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(share * last))];
}

}  // namespace

const OptionTable& option_table(const CalibrationOptions&) {
  static constexpr OptionTable kTable{kCalibrationRows};
  return kTable;
}

Result<void> validate(const CalibrationOptions& options) {
  return check_options(options);
}

CalibrationReport calibration(std::span<const Prediction> predictions,
                              const CalibrationOptions& options) {
  CalibrationReport report{.n = predictions.size()};
  if (predictions.empty()) return report;
  report.bins = filled_bins({predictions.begin(), predictions.end()}, options.num_bins);
  report.expected_error = error_of(report.bins, report.n);
  report.log_loss = log_loss_of(predictions);
  const std::vector<double> errors = bootstrap_errors(predictions, options);
  report.error_low = quantile(errors, 0.025);
  report.error_high = quantile(errors, 0.975);
  return report;
}

}  // namespace hypermap
