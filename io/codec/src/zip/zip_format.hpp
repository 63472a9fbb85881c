// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The records of a zip file, byte for byte.
///
/// Source: PKWARE APPNOTE.TXT 6.3, sections 4.3.7, 4.3.9, 4.3.12 and 4.3.16.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hypermap::zip {

inline constexpr std::uint32_t kLocalSignature = 0x04034b50;
inline constexpr std::uint32_t kDescriptorSignature = 0x08074b50;
inline constexpr std::uint32_t kCentralSignature = 0x02014b50;
inline constexpr std::uint32_t kEndSignature = 0x06054b50;
inline constexpr std::uint32_t kZip64EndSignature = 0x06064b50;
inline constexpr std::uint32_t kZip64LocatorSignature = 0x07064b50;

inline constexpr std::size_t kLocalBytes = 30;    ///< Before name and extra field.
inline constexpr std::size_t kCentralBytes = 46;  ///< Before name, extra field and comment.
inline constexpr std::size_t kEndBytes = 22;      ///< Before the comment.

inline constexpr std::size_t kZip64EndBytes = 56;  ///< Without extensible data.
inline constexpr std::size_t kZip64LocatorBytes = 20;

inline constexpr std::uint16_t kStored = 0;
inline constexpr std::uint16_t kDeflated = 8;

inline constexpr std::uint16_t kFlagEncrypted = 1U << 0;
inline constexpr std::uint16_t kFlagsDeflateLevel = 3U << 1;
inline constexpr std::uint16_t kFlagDescriptor = 1U << 3;
inline constexpr std::uint16_t kFlagStrongEncryption = 1U << 6;
inline constexpr std::uint16_t kFlagUtf8 = 1U << 11;
inline constexpr std::uint16_t kFlagMaskedHeader = 1U << 13;

inline constexpr std::uint16_t kExtraZip64 = 0x0001;
inline constexpr std::uint16_t kExtraUnicodeName = 0x7075;

inline constexpr std::uint32_t kZip64Marker32 = 0xffffffff;
inline constexpr std::uint16_t kZip64Marker16 = 0xffff;

/// Requires: at + 2 (or 4, or 8) <= bytes.size().
[[nodiscard]] inline std::uint16_t get16(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[at]) |
                                    static_cast<unsigned char>(bytes[at + 1]) << 8);
}
[[nodiscard]] inline std::uint32_t get32(std::string_view bytes, std::size_t at) {
  return get16(bytes, at) | static_cast<std::uint32_t>(get16(bytes, at + 2)) << 16;
}
[[nodiscard]] inline std::uint64_t get64(std::string_view bytes, std::size_t at) {
  return get32(bytes, at) | static_cast<std::uint64_t>(get32(bytes, at + 4)) << 32;
}

inline void put16(std::string& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<char>(value & 0xffU));
  bytes.push_back(static_cast<char>(value >> 8U & 0xffU));
}
inline void put32(std::string& bytes, std::uint32_t value) {
  put16(bytes, value & 0xffffU);
  put16(bytes, value >> 16U);
}
inline void put64(std::string& bytes, std::uint64_t value) {
  put32(bytes, static_cast<std::uint32_t>(value & 0xffffffffU));
  put32(bytes, static_cast<std::uint32_t>(value >> 32U));
}

}  // namespace hypermap::zip
