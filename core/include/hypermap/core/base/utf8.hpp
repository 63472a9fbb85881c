// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether bytes are UTF-8, and where its characters end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap {

/// Bytes of the UTF-8 sequence that starts at text[at]; 0 when there is no valid one (cut,
/// overlong, a surrogate, beyond U+10FFFF). Requires: at < text.size().
[[nodiscard]] std::size_t utf8_length(std::string_view text, std::size_t at);

/// Position of the first byte that is no UTF-8; text.size() when all is well.
[[nodiscard]] std::size_t first_bad_utf8(std::string_view text);

/// Writes one character. Requires: `code` is a scalar value (below 0x110000, no surrogate).
void append_utf8(std::string& text, std::uint32_t code);

/// The small letter of a capital of ASCII; any other byte as it is, whatever the locale.
[[nodiscard]] constexpr char lower_ascii(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace hypermap
