// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// UTF-8: recognised and written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

/// Bytes of the sequence at `text[at]`; 0 when it is none (overlong, surrogate, beyond U+10FFFF).
[[nodiscard]] std::size_t utf8_length(std::string_view text, std::size_t at);

/// True for well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
/// Source: The Unicode Standard 15, table 3-7.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Requires: `code` is a scalar value.
void append_utf8(std::string& text, std::uint32_t code);

}  // namespace hypermap
