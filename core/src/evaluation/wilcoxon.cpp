// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/wilcoxon.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kMaxExactPairs = 30;

/// A difference that is not 0, and its rank among the absolute ones, doubled so that the mean of
/// tied ranks stays whole.
struct RankedDifference {
  double difference = 0.0;
  std::uint32_t doubled_rank = 0;
};

std::vector<RankedDifference> ranked(std::span<const double> a, std::span<const double> b) {
  std::vector<RankedDifference> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i]) pairs.push_back({.difference = a[i] - b[i]});
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
    return std::abs(x.difference) < std::abs(y.difference);
  });
  for (std::size_t first = 0; first < pairs.size();) {
    std::size_t end = first + 1;
    while (end < pairs.size() &&
           std::abs(pairs[end].difference) == std::abs(pairs[first].difference)) {
      ++end;
    }
    // Ranks first+1 .. end share their mean (first + 1 + end) / 2.
    for (std::size_t i = first; i < end; ++i) {
      pairs[i].doubled_rank = static_cast<std::uint32_t>(first + 1 + end);
    }
    first = end;
  }
  return pairs;
}

std::uint32_t doubled_rank_sum(const std::vector<RankedDifference>& pairs) {
  std::uint32_t sum = 0;
  for (const auto& pair : pairs) sum += pair.difference > 0.0 ? pair.doubled_rank : 0;
  return sum;
}

/// Share of all sign patterns whose doubled rank sum is at least `observed`.
double exact_p(const std::vector<RankedDifference>& pairs, std::uint32_t observed) {
  std::uint32_t largest = 0;
  for (const auto& pair : pairs) largest += pair.doubled_rank;
  std::vector<double> patterns(largest + 1, 0.0);
  patterns[0] = 1.0;
  for (const auto& pair : pairs) {
    for (std::size_t sum = largest; sum >= pair.doubled_rank; --sum) {
      patterns[sum] += patterns[sum - pair.doubled_rank];
    }
  }
  double at_least = 0.0;
  for (std::size_t sum = observed; sum < patterns.size(); ++sum) at_least += patterns[sum];
  return at_least / std::pow(2.0, static_cast<double>(pairs.size()));
}

/// Normal approximation; ties enter through the sum of the squared ranks, which is the variance.
double normal_p(const std::vector<RankedDifference>& pairs, double rank_sum) {
  double mean = 0.0;
  double variance = 0.0;
  for (const auto& pair : pairs) {
    const double rank = 0.5 * pair.doubled_rank;
    mean += 0.5 * rank;
    variance += 0.25 * rank * rank;
  }
  const double z = (rank_sum - mean - 0.5) / std::sqrt(variance);
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

}  // namespace

Result<WilcoxonResult> wilcoxon_one_sided(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "samples must be paired, are " + std::to_string(a.size()) + " and " +
                    std::to_string(b.size()));
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(a.begin(), a.end(), is_finite) || !std::all_of(b.begin(), b.end(), is_finite)) {
    return fail(ErrorCode::kInvalidArgument, "samples must be finite");
  }
  const auto pairs = ranked(a, b);
  WilcoxonResult result{.n = pairs.size()};
  if (pairs.empty()) return result;
  const std::uint32_t observed = doubled_rank_sum(pairs);
  result.rank_sum = 0.5 * observed;
  result.exact = pairs.size() <= kMaxExactPairs;
  result.p = result.exact ? exact_p(pairs, observed) : normal_p(pairs, result.rank_sum);
  return result;
}

}  // namespace hypermap
