// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The message for an option outside its range.
#pragma once

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/result.hpp"

#include <string>

namespace hypermap {

/// For example out_of_range("num_bins", "must be in 4..360", 3).
[[nodiscard]] inline Unexpected out_of_range(const std::string& field,
                                             const std::string& rule,
                                             double value) {
  return fail(ErrorCode::kInvalidArgument, rule + ", is " + number_text(value), field);
}

}  // namespace hypermap
