// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/binary_counts.hpp"

namespace hypermap {
namespace {

/// `part` of `part` and `rest` together.
std::optional<double> share(std::size_t part, std::size_t rest) {
  const std::size_t whole = part + rest;
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::optional<double> BinaryCounts::true_positive_rate() const {
  return share(true_positives, false_negatives);
}

std::optional<double> BinaryCounts::true_negative_rate() const {
  return true_negatives ? share(*true_negatives, false_positives) : std::nullopt;
}

std::optional<double> BinaryCounts::false_positive_rate() const {
  return true_negatives ? share(false_positives, *true_negatives) : std::nullopt;
}

std::optional<double> BinaryCounts::false_negative_rate() const {
  return share(false_negatives, true_positives);
}

std::optional<double> BinaryCounts::accuracy() const {
  if (!true_negatives) return std::nullopt;
  return share(true_positives + *true_negatives, false_positives + false_negatives);
}

std::optional<double> BinaryCounts::precision() const {
  return share(true_positives, false_positives);
}

std::optional<double> BinaryCounts::f1() const {
  return share(2 * true_positives, false_positives + false_negatives);
}

BinaryCounts& BinaryCounts::operator+=(const BinaryCounts& other) {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  if (!other.true_negatives) true_negatives = std::nullopt;
  if (true_negatives) *true_negatives += *other.true_negatives;
  return *this;
}

}  // namespace hypermap
