// SPDX-License-Identifier: BSD-3-Clause
#include "zip_records.hpp"

#include "zip_format.hpp"

#include <algorithm>
#include <string_view>

namespace hypermap::zip {
namespace {

constexpr std::uint32_t kVersionNeeded = 20;       // 2.0: deflate
constexpr std::uint32_t kVersionOfZip64 = 45;      // 4.5
constexpr std::uint32_t kMadeBy = 3U << 8U | 30U;  // Unix, so that the mode is read
constexpr std::uint32_t kMode = 0100644U << 16U;
constexpr std::size_t kWideOffsetBytes = 12;       // extra field with one number
constexpr std::uint32_t kDosTime = 0;              // 00:00
constexpr std::uint32_t kDosDate = 1U << 5U | 1U;  // 1980-01-01, the first day that zip knows

bool is_ascii(std::string_view name) {
  for (const char c : name)
    if (static_cast<unsigned char>(c) >= 0x80) return false;
  return true;
}

/// What local and central header share. Source: APPNOTE 4.3.7, from "version needed" to sizes.
void put_common(std::string& out, const ZipMember& member, std::size_t num_extra_bytes) {
  put16(out, num_extra_bytes == 0 ? kVersionNeeded : kVersionOfZip64);
  put16(out, is_ascii(member.name) ? 0 : kFlagUtf8);
  put16(out, member.deflated ? kDeflated : kStored);
  put16(out, kDosTime);
  put16(out, kDosDate);
  put32(out, member.crc32);
  put32(out, static_cast<std::uint32_t>(member.num_packed_bytes));
  put32(out, static_cast<std::uint32_t>(member.num_bytes));
  put16(out, static_cast<std::uint32_t>(member.name.size()));
  put16(out, static_cast<std::uint32_t>(num_extra_bytes));
}

std::uint64_t header_offset(const ZipMember& member) {
  return member.data_offset - kLocalBytes - member.name.size();
}

std::uint32_t or_marker(std::uint64_t number) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(number, kZip64Marker32));
}

void put_central(std::string& out, const ZipMember& member) {
  const std::uint64_t offset = header_offset(member);
  const bool is_wide = offset >= kZip64Marker32;
  put32(out, kCentralSignature);
  put16(out, kMadeBy);
  put_common(out, member, is_wide ? kWideOffsetBytes : 0);
  put16(out, 0);  // comment
  put16(out, 0);  // disk
  put16(out, 0);  // internal attributes
  put32(out, kMode);
  put32(out, or_marker(offset));
  out += member.name;
  if (!is_wide) return;
  put16(out, kExtraZip64);
  put16(out, 8);
  put64(out, offset);
}

struct Directory {
  std::uint64_t num_entries = 0;
  std::uint64_t offset = 0;
  std::uint64_t num_bytes = 0;

  [[nodiscard]] bool is_wide() const {
    return num_entries >= kZip64Marker16 || offset >= kZip64Marker32 || num_bytes >= kZip64Marker32;
  }
};

/// The end record of zip64 and its locator.
void put_wide_end(std::string& out, const Directory& directory) {
  put32(out, kZip64EndSignature);
  put64(out, kZip64EndBytes - 12);
  put16(out, kMadeBy);
  put16(out, kVersionOfZip64);
  put32(out, 0);  // this disk
  put32(out, 0);  // disk of the directory
  put64(out, directory.num_entries);
  put64(out, directory.num_entries);
  put64(out, directory.num_bytes);
  put64(out, directory.offset);
  put32(out, kZip64LocatorSignature);
  put32(out, 0);  // disk of the record above
  put64(out, directory.offset + directory.num_bytes);
  put32(out, 1);  // disks
}

void put_end(std::string& out, const Directory& directory) {
  const auto num_entries =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(directory.num_entries, kZip64Marker16));
  put32(out, kEndSignature);
  put16(out, 0);  // this disk
  put16(out, 0);  // disk of the directory
  put16(out, num_entries);
  put16(out, num_entries);
  put32(out, or_marker(directory.num_bytes));
  put32(out, or_marker(directory.offset));
  put16(out, 0);  // comment
}

}  // namespace

std::string local_header(const ZipMember& member) {
  std::string out;
  put32(out, kLocalSignature);
  put_common(out, member, 0);
  return out + member.name;
}

std::string directory_of(std::span<const ZipMember> members, std::uint64_t offset) {
  std::string out;
  for (const ZipMember& member : members) put_central(out, member);
  const Directory directory{
      .num_entries = members.size(), .offset = offset, .num_bytes = out.size()};
  if (directory.is_wide()) put_wide_end(out, directory);
  put_end(out, directory);
  return out;
}

}  // namespace hypermap::zip
