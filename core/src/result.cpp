// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/result.hpp"

#include <array>

namespace hypermap {
namespace {

/// Bytes of the UTF-8 sequence that starts at text[at]; 0 when there is no valid one.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
  }
  const unsigned char second = byte(at + 1);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second > 0x9F;
  const bool too_large = lead == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

std::string hex_escape(unsigned char byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
}

}  // namespace

Unexpected fail(ErrorCode code, std::string what, std::string field) {
  return Unexpected(Error{.code = code, .what = std::move(what), .field = std::move(field)});
}

std::string printable(std::string_view text, std::size_t max_bytes) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_control = byte < 0x20 || byte == 0x7F;
    std::string piece =
        length == 0 || is_control ? hex_escape(byte) : std::string(text.substr(i, length));
    if (out.size() + piece.size() > max_bytes) return out + "...";
    out += piece;
    i += length == 0 ? 1 : length;
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
