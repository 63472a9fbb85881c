// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether bytes are UTF-8.
#pragma once

#include <string_view>

namespace hypermap {

/// True for well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
/// Source: The Unicode Standard 15, table 3-7.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace hypermap
