// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Text in columns.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {

/// `value` with `digits` behind the point; "-" when there is none.
[[nodiscard]] std::string fixed(const std::optional<double>& value, int digits);

/// Both with as many digits, at least two and at most nine, as tell them apart; equal numbers with
/// two.
[[nodiscard]] std::pair<std::string, std::string> fixed_apart(double a, double b);

/// What the last column of a table holds: text is left-aligned.
enum class LastColumn { kNumber, kText };

/// Rows under a heading, each column as wide as its widest cell; the first column is left-aligned.
class Table {
 public:
  explicit Table(std::vector<std::string> heading, LastColumn last = LastColumn::kNumber);
  /// Requires: as many cells as the heading.
  void add(std::vector<std::string> row);
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
  LastColumn last_;
};

}  // namespace hypermap::app
