// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Right and wrong decisions whether something is there, and the rates that are made of them.
///
/// Source: [smap] appendix B.
#pragma once

#include <cstddef>
#include <optional>

namespace hypermap {

/// How many decisions of a kind there were. Each rate is none where it would divide by 0, and where
/// it needs true negatives that nobody counted.
struct BinaryCounts {
  std::size_t true_positives = 0;
  std::size_t false_positives = 0;
  std::size_t false_negatives = 0;
  std::optional<std::size_t> true_negatives = 0;  ///< None: cannot be known.

  /// TPr, the recall: of what is there, the share that was said to be. Source: [smap] Eq. (B.1).
  [[nodiscard]] std::optional<double> true_positive_rate() const;
  /// TNr: of what is not there, the share that was said not to be. Source: [smap] Eq. (B.2).
  [[nodiscard]] std::optional<double> true_negative_rate() const;
  /// FPr = 1 - TNr. Source: [smap] Eq. (B.3).
  [[nodiscard]] std::optional<double> false_positive_rate() const;
  /// FNr = 1 - TPr. Source: [smap] Eq. (B.4).
  [[nodiscard]] std::optional<double> false_negative_rate() const;
  /// ACC: share of all decisions that are right. Source: [smap] Eq. (B.5), its binary form.
  [[nodiscard]] std::optional<double> accuracy() const;
  /// PRE: of what was said to be there, the share that is. Source: [smap] Eq. (B.6).
  [[nodiscard]] std::optional<double> precision() const;
  /// F1, the harmonic mean of precision and recall: 2 TP / (2 TP + FP + FN).
  [[nodiscard]] std::optional<double> f1() const;

  /// True negatives of a sum are known where those of both are.
  BinaryCounts& operator+=(const BinaryCounts& other);
  friend bool operator==(const BinaryCounts&, const BinaryCounts&) = default;
};

}  // namespace hypermap
