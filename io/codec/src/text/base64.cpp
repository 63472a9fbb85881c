// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/base64.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hypermap {
namespace {

constexpr std::string_view kBase64Letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr char kPadding = '=';
constexpr std::size_t kBytesPerGroup = 3;
constexpr std::size_t kLettersPerGroup = 4;
constexpr std::uint8_t kNoLetter = 64;

constexpr std::array<std::uint8_t, 256> values_of_letters() {
  std::array<std::uint8_t, 256> values{};
  for (std::uint8_t& value : values) value = kNoLetter;
  for (std::size_t i = 0; i < kBase64Letters.size(); ++i) {
    values.at(static_cast<unsigned char>(kBase64Letters[i])) = static_cast<std::uint8_t>(i);
  }
  return values;
}

constexpr std::array<std::uint8_t, 256> kValues = values_of_letters();

}  // namespace

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + kBytesPerGroup - 1) / kBytesPerGroup * kLettersPerGroup);
  for (std::size_t i = 0; i < bytes.size(); i += kBytesPerGroup) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < kBytesPerGroup; ++k) {
      const bool is_there = i + k < bytes.size();
      group = (group << 8U) | (is_there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < kLettersPerGroup; ++k) {
      const bool is_padding = i + k > bytes.size();
      text += is_padding ? kPadding : kBase64Letters[(group >> (18U - 6U * k)) & 63U];
    }
  }
  return text;
}

Result<std::string> decode_base64(std::string_view text) {
  if (text.size() % kLettersPerGroup != 0) {
    return fail(ErrorCode::kMalformedFile,
                "base64 must have a multiple of 4 letters, has " + std::to_string(text.size()));
  }
  std::size_t num_letters = text.size();
  while (num_letters + 2 > text.size() && num_letters > 0 && text[num_letters - 1] == kPadding) {
    --num_letters;
  }
  std::string bytes;
  bytes.reserve(text.size() / kLettersPerGroup * kBytesPerGroup);
  std::uint32_t bits = 0;
  std::uint32_t num_bits = 0;
  for (std::size_t i = 0; i < num_letters; ++i) {
    const std::uint8_t value = kValues.at(static_cast<unsigned char>(text[i]));
    if (value == kNoLetter) {
      return fail(ErrorCode::kMalformedFile,
                  "base64 must be letters, digits, + and /, is not at " + std::to_string(i));
    }
    bits = ((bits << 6U) | value) & 0xffffU;
    num_bits += 6U;
    if (num_bits < 8U) continue;
    num_bits -= 8U;
    bytes += static_cast<char>(static_cast<unsigned char>((bits >> num_bits) & 0xffU));
  }
  if ((bits & ((1U << num_bits) - 1U)) == 0U) return bytes;
  return fail(ErrorCode::kMalformedFile, "base64 must end in bits of 0");
}

}  // namespace hypermap
