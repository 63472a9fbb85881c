// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far depth is used where nobody says otherwise.
#pragma once

namespace hypermap {

/// Structured light sees a room. Unit: metre.
inline constexpr double kDefaultMaxRangeM = 5.0;

}  // namespace hypermap
