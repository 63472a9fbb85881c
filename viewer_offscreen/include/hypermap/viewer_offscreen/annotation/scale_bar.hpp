// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How long a scale bar or a grid step is: a round number of metres.
#pragma once

#include <string>

namespace hypermap {

/// The largest of 1, 2 and 5 times a power of ten that is not above `max_length_m`.
/// Requires: max_length_m finite and > 0.
[[nodiscard]] double round_length_m(double max_length_m);

/// "5 m", "50 cm", "2 mm", "1 km", "0.2 mm".
[[nodiscard]] std::string length_text(double length_m);

}  // namespace hypermap
