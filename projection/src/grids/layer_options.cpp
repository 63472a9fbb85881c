// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/layer_options.hpp"

#include <cmath>
#include <string>

namespace hypermap {

Result<void> validate(const LayerOptions& options) {
  if (!std::isfinite(options.min_height_m)) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "min_height_m");
  }
  if (!std::isfinite(options.max_height_m) || options.max_height_m <= options.min_height_m) {
    return fail(ErrorCode::kInvalidArgument,
                "must be finite and above min_height_m, is " + std::to_string(options.max_height_m),
                "max_height_m");
  }
  if (!(options.min_free_share > 0.0 && options.min_free_share <= 1.0)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be above 0 and at most 1, is " + std::to_string(options.min_free_share),
                "min_free_share");
  }
  return {};
}

}  // namespace hypermap
