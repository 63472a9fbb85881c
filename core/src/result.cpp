// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/result.hpp"

#include "hypermap/core/utf8.hpp"

#include <array>

namespace hypermap {
namespace {

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
