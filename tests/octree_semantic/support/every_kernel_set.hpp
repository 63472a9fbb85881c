// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The kernels of every instruction set, for tests that want each to give the same.
#pragma once

#include "kernels/kernels.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace hypermap::kernels {

/// The kernels of each set that this processor and compiler have.
inline std::vector<Kernels> all_sets() {
  std::vector<Kernels> sets;
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Kernels& set = best_kernels();
    const bool is_new = std::none_of(sets.begin(), sets.end(), [&](const Kernels& other) {
      return std::strcmp(other.name, set.name) == 0;
    });
    if (is_new) sets.push_back(set);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return sets;
}

class EverySet : public ::testing::TestWithParam<Kernels> {
 protected:
  [[nodiscard]] const Kernels& set() const { return GetParam(); }
  const Kernels& scalar_ = scalar_kernels();
  std::mt19937 random_{11};
};

}  // namespace hypermap::kernels
