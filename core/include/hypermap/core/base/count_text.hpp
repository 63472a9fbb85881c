// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Counts in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hypermap {

/// "1 frame", "2 frames", "0 frames". Requires: `noun` is singular and its plural ends in s alone.
[[nodiscard]] inline std::string count_text(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace hypermap
