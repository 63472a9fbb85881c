// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/series_sample.hpp"

#include <algorithm>

namespace hypermap {

void SeriesSample::add(double value) {
  min_ = n_ == 0 ? value : std::min(min_, value);
  max_ = n_ == 0 ? value : std::max(max_, value);
  const std::size_t place = n_++;
  if (place % stride_ != 0) return;
  if (kept_.size() == kCapacity) {
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize(kCapacity / 2);
    stride_ *= 2;
    // kCapacity strides are a whole number of doubled ones, so this value is one of those kept.
  }
  kept_.push_back(value);
}

FiveNumbers SeriesSample::numbers() const {
  FiveNumbers numbers = five_numbers(kept_);
  numbers.min = min_;
  numbers.max = max_;
  return numbers;
}

}  // namespace hypermap
