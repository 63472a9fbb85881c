// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Means that say when there is nothing to average.
#pragma once

#include <cstddef>
#include <optional>

namespace hypermap {

class RunningMean {
 public:
  void add(double value) {
    sum_ += value;
    ++n_;
  }
  [[nodiscard]] std::size_t n() const { return n_; }
  [[nodiscard]] std::optional<double> value() const {
    return n_ == 0 ? std::nullopt : std::optional(sum_ / static_cast<double>(n_));
  }

 private:
  double sum_ = 0.0;
  std::size_t n_ = 0;
};

}  // namespace hypermap
