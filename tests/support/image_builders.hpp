// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// PNG files byte by byte, right and wrong ones.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::test {

inline constexpr std::string_view kSignature{"\x89PNG\r\n\x1A\n", 8};

inline std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24U),
          static_cast<char>(value >> 16U),
          static_cast<char>(value >> 8U),
          static_cast<char>(value)};
}

inline std::string chunk(const std::string& type, const std::vector<std::uint8_t>& content) {
  const std::string body = type + std::string(content.begin(), content.end());
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(content.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

inline std::string ihdr(
    std::uint32_t width, std::uint32_t height, int bits, int color, int interlace = 0) {
  const std::string sides = big_endian(width) + big_endian(height);
  std::vector<std::uint8_t> content(sides.begin(), sides.end());
  for (const int value : {bits, color, 0, 0, interlace}) {
    content.push_back(static_cast<std::uint8_t>(value));
  }
  return chunk("IHDR", content);
}

inline std::string deflated(const std::string& raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()),
            &size,
            reinterpret_cast<const Bytef*>(raw.data()),
            static_cast<uLong>(raw.size()),
            9);
  out.resize(size);
  return out;
}

/// A file of these filtered rows (filter type first), `between` standing before the pixels.
inline std::string png(const std::string& header,
                       const std::vector<std::vector<std::uint8_t>>& rows,
                       const std::string& between = "") {
  std::string raw;
  for (const auto& row : rows) raw.append(row.begin(), row.end());
  const std::string data = deflated(raw);
  return std::string(kSignature) + header + between +
         chunk("IDAT", std::vector<std::uint8_t>(data.begin(), data.end())) + chunk("IEND", {});
}

}  // namespace hypermap::test
