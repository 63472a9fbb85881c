// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/result.hpp"

#include "hypermap/core/base/utf8.hpp"

#include <algorithm>
#include <array>

namespace hypermap {
namespace {

std::string hex_escaped(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
  }
  return out;
}

/// Of ASCII; U+0080 .. U+009F, which steer some terminals; and what turns or breaks the text around
/// it: the marks, embeddings, overrides and isolates of bidirectional text (U+061C, U+200E, U+200F,
/// U+202A .. U+202E, U+2066 .. U+2069) and the separators U+2028 and U+2029.
bool is_control(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (byte(0) < 0x80) return byte(0) < 0x20 || byte(0) == 0x7F;
  if (character.size() == 2)
    return (byte(0) == 0xC2 && byte(1) < 0xA0) || (byte(0) == 0xD8 && byte(1) == 0x9C);
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  const unsigned last = byte(2);
  return (byte(1) == 0x80 && (last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE))) ||
         (byte(1) == 0x81 && last >= 0xA6 && last <= 0xA9);
}

}  // namespace

Unexpected fail(ErrorCode code, std::string what, std::string field) {
  return Unexpected(Error{.code = code, .what = std::move(what), .field = std::move(field)});
}

std::string printable(std::string_view text, std::size_t max_bytes) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const std::string_view character = text.substr(i, std::max<std::size_t>(length, 1));
    const bool is_printable = length > 0 && !is_control(character);
    const std::string piece = is_printable ? std::string(character) : hex_escaped(character);
    if (out.size() + piece.size() > max_bytes) return out + "...";
    out += piece;
    i += character.size();
  }
  return out;
}

std::string to_string(const Error& error) {
  std::string out = printable(error.file, 4096);
  if (!error.entry.empty()) out += "!" + printable(error.entry);
  if (error.line > 0) out += ":" + std::to_string(error.line);
  for (const std::string& part : {error.field, error.what}) {
    if (part.empty()) continue;
    if (!out.empty()) out += ": ";
    out += printable(part, 1000);
  }
  return out;
}

}  // namespace hypermap
