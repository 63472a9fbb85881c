// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/checksum.hpp"

#include <libdeflate.h>

namespace hypermap {

std::uint32_t crc32_of(std::string_view content, std::uint32_t before) {
  return libdeflate_crc32(before, content.data(), content.size());
}

std::string checksum_text(std::uint32_t crc) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned shift = 32; shift > 0; shift -= 4) text += kDigits[crc >> (shift - 4U) & 15U];
  return text;
}

}  // namespace hypermap
