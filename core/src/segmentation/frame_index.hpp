// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which positions in a sequence a map can remember.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstdint>

namespace hypermap {

/// Errors: kInvalidArgument (field `index`) beyond 2^63 - 1, which archives do not hold.
[[nodiscard]] Result<void> check_frame_index(std::uint64_t index);

}  // namespace hypermap
