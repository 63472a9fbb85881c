// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether what is said to be true with probability p is true in a share p of all cases.
///
/// Source: M. P. Naeini, G. Cooper, M. Hauskrecht, "Obtaining well calibrated probabilities using
/// Bayesian binning", 2015 (expected calibration error), here with equally filled bins.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What was said, and whether it was so.
struct Prediction {
  double probability = 0.0;
  bool is_true = false;
};

struct CalibrationOptions {
  int num_bins = 10;         ///< Equally filled. Range: 1 .. 1000
  int num_resamples = 1000;  ///< Of the bootstrap. Range: 1 .. 100,000
  std::uint64_t seed = 1;    ///< Of the bootstrap.
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const CalibrationOptions& options);
[[nodiscard]] const OptionTable& option_table(const CalibrationOptions& options);

struct CalibrationBin {
  std::size_t n = 0;
  double mean_probability = 0.0;
  double true_share = 0.0;
};

struct CalibrationReport {
  std::size_t n = 0;
  /// Means over the predictions; none without any.
  std::optional<double> expected_error = {};  ///< Of |mean probability - true share| of the bins.
  std::optional<double> log_loss = {};    ///< Of -ln(probability of what was so), p in 1e-6 .. 1.
  double error_low = 0.0;                 ///< 95 % of the bootstrap's errors lie from here ...
  double error_high = 0.0;                ///< ... to here.
  std::vector<CalibrationBin> bins = {};  ///< In ascending order of probability, none empty.
};

/// The order of the predictions does not matter: equal probabilities share their outcomes.
///
/// Requires: validate(options), probabilities in 0 .. 1.
/// Boundary: fewer predictions than bins give a bin each.
/// Cost: O(resamples n log n).
[[nodiscard]] CalibrationReport calibration(std::span<const Prediction> predictions,
                                            const CalibrationOptions& options = {});

}  // namespace hypermap
